// SPDX-License-Identifier: Apache-2.0
// The graphics of this computer, and the 2D view for one that cannot draw the room.
import { FlatMarks } from "./flat_marks.js";

const software = /llvmpipe|softpipe|swiftshader|swrast|microsoft basic render/i;
const flat_every_ms = 200;

// "card", "processor" (WebGL drawn by the processor) or "none" (no WebGL 2).
export function find_graphics() {
    const gl = document.createElement("canvas").getContext("webgl2");
    if (!gl)
        return "none";
    const names = gl.getExtension("WEBGL_debug_renderer_info");
    const name = gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
    return software.test(name) ? "processor" : "card";
}

// One camera's picture on a canvas, a few times a second, with what people do on it above.
export class FlatView {
    constructor(canvas, over, module, client) {
        Object.assign(this, { canvas, marks: new FlatMarks(over, canvas), module, client, next_ms: 0 });
    }

    clear() {
        if (this.canvas.width > 1)
            this.canvas.width = this.canvas.height = 1;
    }

    // True if the picture is a new one.
    draw(now_ms) {
        this.marks.draw(this.client.flat_step());
        if (now_ms < this.next_ms)
            return false;
        this.next_ms = now_ms + flat_every_ms;
        const address = this.client.flat_picture();
        if (!address)
            return false;
        const width = this.client.flat_width(), height = this.client.flat_height();
        const pixels = this.module.HEAPU8.subarray(address, address + 4 * width * height);
        if (this.canvas.width !== width || this.canvas.height !== height)
            Object.assign(this.canvas, { width, height });
        this.canvas.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(pixels), width, height), 0, 0);
        return true;
    }
}

// Tells when the room is drawn too slowly for long: true once.
export class Patience {
    static slowest_per_s = 1;
    static longest_ms = 10000;

    is_over(now_ms, { drawn_per_second, has_picture }) {
        if (!has_picture || drawn_per_second >= Patience.slowest_per_s)
            this.slow_since = null;
        else
            this.slow_since ??= now_ms;
        return this.slow_since !== null && now_ms - this.slow_since > Patience.longest_ms;
    }
}

// The page is loaded again when the browser's graphics stop, since nothing of them is left. This tab remembers it for that one
// load, and whether the microphone was open.
const lost_key = "theatron_lost_graphics", lost_at_key = "theatron_lost_graphics_at", often_ms = 60000;

export function note_lost_graphics(speaks) {
    try {
        const last = Number(sessionStorage.getItem(lost_at_key));
        sessionStorage.setItem(lost_key, JSON.stringify({ speaks, is_often: Date.now() - last < often_ms }));
        sessionStorage.setItem(lost_at_key, String(Date.now()));
    } catch {
        // The person enters again by hand.
    }
}

// Null where nothing was lost before this load.
export function take_lost_graphics() {
    try {
        const lost = JSON.parse(sessionStorage.getItem(lost_key));
        sessionStorage.removeItem(lost_key);
        return lost;
    } catch {
        return null;
    }
}
