// SPDX-License-Identifier: Apache-2.0
// Push to talk with Enter on an element; a button's also by the pointer and the space bar.
export function hold_to_talk(element, voice) {
    const is_button = element.tagName === "BUTTON";
    const is_key = ({ key }) => key === "Enter" || (is_button && key === " ");
    // The other element may be held when this one loses the focus.
    let is_held = false;
    const hold = now => {
        if (is_held !== now)
            voice.talk(is_held = now);
    };
    element.addEventListener("keydown", event => is_key(event) && hold(true));
    element.addEventListener("keyup", event => is_key(event) && hold(false));
    element.addEventListener("blur", () => hold(false));
    if (!is_button)
        return;
    element.addEventListener("pointerdown", event => {
        hold(true);
        element.setPointerCapture(event.pointerId);
    });
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"])
        element.addEventListener(end, () => hold(false));
    element.addEventListener("contextmenu", event => event.preventDefault());  // of a long touch
}
