// SPDX-License-Identifier: Apache-2.0
// A person may use this page by touch: then there are buttons for what keys do, and no text names a key.
const followers = [];
let is_on = matchMedia("(pointer: coarse)").matches;

export const by_touch = () => is_on;

// Calls `follow` now, and when the first finger touches the page.
export function follow_touch(follow) {
    followers.push(follow);
    follow();
}

addEventListener("pointerdown", ({ pointerType }) => {
    if (is_on || pointerType !== "touch")
        return;
    is_on = true;
    for (const follow of followers)
        follow();
}, { capture: true });
