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

// The client's own sentences, in English, as somebody without a keyboard reads them.
const without_keys = [
    [/ ?Press Esc to leave\.$/, ""],
    [/ Esc: leave\.$/, ""],
    [/: Y lets in, U refuses$/, ""],
    [/\. Space: live again$/, ""],
    [/, frozen\. Space: go on; End: live again$/, ", frozen"],
    [/\. End: live again$/, ""],
    [/press M until "auto" appears$/, 'choose "Automatic" in "Picture"'],
    [/; (\w+) has no points, splat and disc have \(M\)$/, "; $1 has no points, splat and disc have"],
    [/^P shows the screens/, '"People" shows the screens'],
    [/^O shows the case/, '"Case" shows the case'],
    [/^Hold an object with the left mouse button first$/, "Hold an object with a finger first"],
    [/ \(J: go there\)$/, ""],
    [/; comma and period go to other moments$/, ""],
    [/^is recorded, F8 ends that$/, "is recorded"],
    [/^is not recorded, F8 agrees$/, "is not recorded"],
];

export function for_touch(english) {
    return is_on ? without_keys.reduce((text, [pattern, instead]) => text.replace(pattern, instead), english) : english;
}
