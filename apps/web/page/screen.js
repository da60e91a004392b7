// SPDX-License-Identifier: Apache-2.0
// A screen, window or tab of this computer that the person shows to all. It comes as JPEG pictures: each that is another
// one, and twice a second the same one, so that nobody takes the screen for frozen.
import { put_bytes } from "./program.js";

// session/screen_limits.h has the host's limits.
const most_pixels = 1920 * 1200, pictures_per_s = 8, quality = 0.85, again_every_ms = 500, refusal_ms = 10_000;

// The size in which a picture of this size is sent: as it is, or smaller in its shape.
export function sent_size(width, height) {
    const scale = Math.min(1, Math.sqrt(most_pixels / (width * height)));
    return [Math.max(1, Math.floor(width * scale)), Math.max(1, Math.floor(height * scale))];
}

// Where a picture lies in one of another shape: x, y, width and height.
export function place_within([width, height], [outer_width, outer_height]) {
    const scale = Math.min(outer_width / width, outer_height / height);
    const [w, h] = [width * scale, height * scale];
    return [(outer_width - w) / 2, (outer_height - h) / 2, w, h];
}

function are_equal(a, b) {
    if (a?.byteLength !== b.byteLength)
        return false;
    const others = new Uint8Array(b);
    return new Uint8Array(a).every((byte, i) => byte === others[i]);
}

export class Screen {
    // "off", "asking", "on" or "refused": nothing was chosen, or the computer does not allow it.
    state = "off";
    stream = null;
    video = document.createElement("video");
    is_taking = false;
    sent = null;  // the newest picture
    sent_at_ms = 0;

    static is_supported() {
        return Boolean(navigator.mediaDevices?.getDisplayMedia && globalThis.OffscreenCanvas);
    }

    // `name`: a function that gives what the others read above the screen. `changed` is called with each new state.
    constructor(module, client, name, changed) {
        this.module = module;
        this.client = client;
        this.name = name;
        this.changed = changed;
        this.video.muted = this.video.playsInline = true;
    }

    async show() {
        if (this.state === "asking" || this.state === "on")
            return;
        this.be("asking");
        let stream = null;
        try {
            stream = await navigator.mediaDevices.getDisplayMedia({ video: { frameRate: { max: 15 } }, audio: false });
            this.video.srcObject = stream;
            await this.video.play();
        } catch (error) {
            stop(stream);
            if (this.state === "asking")
                this.refuse();
            return;
        }
        if (this.state !== "asking")  // given up while the browser asked
            return stop(stream);
        this.stream = stream;
        // The browser's own button ends it, too.
        stream.getVideoTracks()[0].addEventListener("ended", () => this.stream === stream && this.hide());
        this.canvas = new OffscreenCanvas(...sent_size(this.video.videoWidth, this.video.videoHeight));
        this.be("on");
        this.offer();
        // A worker's clock: the page lies behind the window that is shown, where its own timers hardly run.
        this.clock = new Worker(new URL("./clock_worker.js", import.meta.url));
        this.clock.onmessage = () => this.take();
        this.clock.postMessage(1000 / pictures_per_s);
    }

    // Again for each visit.
    offer() {
        if (this.state === "on")
            this.client.show_screen(this.name(), this.canvas.width, this.canvas.height, pictures_per_s);
    }

    hide(why = "off") {
        this.clock?.terminate();
        stop(this.stream);
        this.clock = this.stream = this.video.srcObject = this.sent = null;
        if (this.state === "on")
            this.client.show_screen("", 0, 0, 0);
        this.be(why);
    }

    // It is said for a while.
    refuse() {
        this.hide("refused");
        setTimeout(() => this.state === "refused" && this.be("off"), refusal_ms);
    }

    be(state) {
        this.state = state;
        this.changed();
    }

    async take() {
        const { videoWidth, videoHeight } = this.video;
        if (this.is_taking || !videoWidth || !videoHeight)
            return;
        this.is_taking = true;
        const begin = performance.now();
        const { canvas } = this;
        const to = canvas.getContext("2d");
        to.fillRect(0, 0, canvas.width, canvas.height);
        to.drawImage(this.video, ...place_within([videoWidth, videoHeight], [canvas.width, canvas.height]));
        // A picture that cannot be encoded is left out; the next one comes soon.
        const jpeg = await canvas.convertToBlob({ type: "image/jpeg", quality }).then(blob => blob.arrayBuffer(), () => null);
        this.is_taking = false;
        if (!jpeg || this.state !== "on" || canvas !== this.canvas ||
            (begin < this.sent_at_ms + again_every_ms && are_equal(this.sent, jpeg)))
            return;
        this.sent = jpeg;
        this.sent_at_ms = begin;
        put_bytes(this.module, jpeg);
        this.client.send_screen(1000 * (performance.now() - begin));
    }
}

function stop(stream) {
    for (const track of stream?.getTracks() ?? [])
        track.stop();
}
