// SPDX-License-Identifier: Apache-2.0
// Mouse, touch and keyboard on the canvas, for the client's functions.

// Keys that act while they are down, by their place on the keyboard: right, up, ahead.
const walking = {
    KeyD: [1, 0, 0], KeyA: [-1, 0, 0], KeyE: [0, 1, 0], KeyQ: [0, -1, 0], KeyW: [0, 0, 1], KeyS: [0, 0, -1],
    ArrowRight: [1, 0, 0], ArrowLeft: [-1, 0, 0], ArrowUp: [0, 0, 1], ArrowDown: [0, 0, -1],
};
const of_page = new Set(["b", "o", "p"]);  // panels, which the page itself opens
const pixels_per_click = 100;  // of a wheel or of a pinch

const whole = ({ clientWidth: width, clientHeight: height }) => ({ left: 0, top: 0, width, height });

// The result is for the buttons of touch.js. `box_of`: the part of the canvas in which the picture is.
export function listen(canvas, client, box_of = whole) {
    let walk = [0, 0, 0];  // by a button
    let tool = "";         // "points" or "teleports": what a press on the picture does instead of turning it
    let using = null;      // the pointer that does it
    let used = () => {};
    let is_over = false;   // a mouse, which points wherever it is
    const share = event => {
        const { left, top, width, height } = box_of(canvas);
        return [(event.offsetX - left) / width, (event.offsetY - top) / height];
    };
    const pointers = new Map();  // id -> place in pixels
    const middle = () => {
        const all = [...pointers.values()];
        return [0, 1].map(i => all.reduce((sum, at) => sum + at[i], 0) / all.length);
    };
    const width = () => {
        const [a, b] = [...pointers.values()];
        return Math.hypot(a[0] - b[0], a[1] - b[1]);
    };

    const points_by = ({ pointerType }) => tool === "points" && pointerType === "mouse";
    const hover = now => {
        if (is_over === now)
            return;
        is_over = now;
        hold();
    };
    canvas.addEventListener("pointerleave", () => hover(false));
    canvas.addEventListener("pointerdown", event => {
        canvas.focus({ preventScroll: true });
        canvas.setPointerCapture(event.pointerId);
        if (tool && using === null && !points_by(event)) {
            using = event.pointerId;
            client.point(...share(event));
            return hold();
        }
        pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
        // A second finger ends what the first one began.
        if (pointers.size > 1)
            client.release();
        const is_left = event.button === 0 && pointers.size === 1;
        client.grab(...share(event), is_left ? 1 : 0);
    });
    canvas.addEventListener("pointermove", event => {
        if (using !== null && using !== event.pointerId)
            return;
        client.point(...share(event));
        hover(points_by(event));
        const before = pointers.get(event.pointerId);
        if (!before)
            return;
        const [x, y] = middle();
        const spread = pointers.size === 2 ? width() : 0;
        pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
        const turns = pointers.size === 1 && (event.pointerType === "touch" || (event.buttons & 1));
        const [now_x, now_y] = middle();
        client.drag((now_x - x) / canvas.clientHeight, (now_y - y) / canvas.clientHeight, turns ? 1 : 0);
        if (pointers.size === 2)
            client.wheel((width() - spread) / pixels_per_click);
    });
    const release = event => {
        if (pointers.delete(event.pointerId))
            client.release();
        if (using !== event.pointerId)
            return;
        using = null;
        hold();
        used(tool);
    };
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
    canvas.addEventListener("contextmenu", event => event.preventDefault());
    canvas.addEventListener("wheel", event => {
        event.preventDefault();
        const scale = event.deltaMode === 0 ? 1 : 33;  // pixels, or lines
        client.wheel(-event.deltaY * scale / pixels_per_click);
    }, { passive: false });

    const held = new Set();
    const hold = event => {
        const sum = [...walk];
        for (const code of held)
            walking[code]?.forEach((part, i) => sum[i] += part);
        const uses = name => using !== null && tool === name;
        client.hold(...sum.map(part => Math.sign(part)), event?.shiftKey ? 1 : 0,
                    held.has("KeyT") || uses("teleports") ? 1 : 0, held.has("KeyF") || uses("points") || is_over ? 1 : 0);
    };
    canvas.addEventListener("keydown", event => {
        if (event.ctrlKey || event.altKey || event.metaKey)
            return;
        held.add(event.code);
        hold(event);
        if (!event.repeat && !of_page.has(event.key.toLowerCase()))
            client.key(event.key.toLowerCase(), event.code);
        if (event.code in walking || event.key === "Home")
            event.preventDefault();
    });
    canvas.addEventListener("keyup", event => {
        held.delete(event.code);
        hold(event);
    });
    canvas.addEventListener("blur", () => {
        held.clear();
        hold();
    });
    return {
        // Right, up, ahead, until the next call.
        walk(way) {
            walk = way;
            hold();
        },
        // `on_used` follows each use.
        choose_tool(name, on_used) {
            [tool, used] = [name, on_used];
            using = null;
            is_over = false;
            hold();
        },
    };
}
