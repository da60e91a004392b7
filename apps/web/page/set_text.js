// SPDX-License-Identifier: Apache-2.0
// A screen reader reads a text again that is set again, also where it stays the same.
export function set_text(place, content) {
    if (place.textContent !== content)
        place.textContent = content;
}
