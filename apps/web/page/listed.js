// SPDX-License-Identifier: Apache-2.0
// A list in words, of which many would cover the picture.
import { text } from "./texts.js";

// The first `most` of these words, and how many more there are.
export function listed(words, most) {
    const shown = words.slice(0, most);
    if (words.length > most)
        shown.push(text("and_more", { count: words.length - most }));
    return shown.join(", ");
}
