// SPDX-License-Identifier: Apache-2.0
// Buttons for what keys do in the room, for people without a keyboard. A finger on the picture may hold an object while
// another one presses a button, so they act when they are touched, not when a click ends.
const step_ms = 400;           // of a press by a screen reader, which has no end
const click_follows_ms = 700;  // of a touch

// `controls`: the result of listen() in input.js for each picture, the room's first. `draws` says whether the tools for drawing
// are out. The result is to be called with each state, since a press on the picture either points or draws; it returns the tool
// that is chosen ("points", "teleports" or "").
export function offer_touch(place, [room, flat], client, draws) {
    const controls = { walk: room.walk, choose_tool: (...tool) => [room, flat].forEach(picture => picture.choose_tool(...tool)) };
    const stand = () => controls.walk([0, 0, 0]);
    for (const button of place.querySelectorAll("[data-walk]"))
        on_hold(button, () => controls.walk(button.dataset.walk.split(" ").map(Number)), stand);
    for (const button of place.querySelectorAll("[data-key]"))
        on_press(button, () => client.key(button.dataset.key, ""));

    const tools = [...document.querySelectorAll("[data-tool]")];  // pointing is in the bar
    let chosen = "";
    const choose = name => {
        chosen = name;
        if (name && draws())
            client.key("z", "");
        for (const button of tools)
            button.setAttribute("aria-pressed", String(button.dataset.tool === name));
        // One goes somewhere once, and points at several things.
        controls.choose_tool(name, used => used === "teleports" && choose(""));
    };
    for (const button of tools)
        on_press(button, () => choose(chosen === button.dataset.tool ? "" : button.dataset.tool));
    place.addEventListener("contextmenu", event => event.preventDefault());  // of a long touch
    let drew = false;
    return () => {
        const now = draws();
        if (now && !drew && chosen)
            choose("");
        drew = now;
        client.flat_points(chosen === "points" ? 1 : 0);
        return chosen;
    };
}

function on_press(button, act) {
    let touched_ms = -Infinity;
    button.addEventListener("pointerdown", event => {
        event.preventDefault();  // the picture keeps the focus
        touched_ms = event.timeStamp;
        act();
    });
    button.addEventListener("pointerup", event => touched_ms = event.timeStamp);
    button.addEventListener("click", event => event.timeStamp - touched_ms > click_follows_ms && act());
}

function on_hold(button, begin, end) {
    let is_held = false, ended_ms = -Infinity, timer;
    const hold = now => {
        if (is_held === now)
            return;
        is_held = now;
        ended_ms = now ? Infinity : performance.now();
        clearTimeout(timer);
        (now ? begin : end)();
    };
    button.addEventListener("pointerdown", event => {
        event.preventDefault();
        button.setPointerCapture(event.pointerId);
        hold(true);
    });
    for (const name of ["pointerup", "pointercancel", "lostpointercapture", "blur"])
        button.addEventListener(name, () => hold(false));
    const is_key = ({ key }) => key === "Enter" || key === " ";
    button.addEventListener("keydown", event => is_key(event) && hold(true));
    button.addEventListener("keyup", event => is_key(event) && hold(false));
    button.addEventListener("click", event => {
        if (event.detail > 0 || performance.now() - ended_ms < click_follows_ms)
            return;  // behind a touch or a key
        hold(true);
        timer = setTimeout(() => hold(false), step_ms);
    });
}
