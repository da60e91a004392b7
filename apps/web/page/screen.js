// SPDX-License-Identifier: Apache-2.0
// A screen, window or tab of this computer that the person shows to all. It comes as JPEG pictures: each that is another
// one, and twice a second the same one, so that nobody takes the screen for frozen.
import { put_bytes } from "./program.js";
import { stop_tracks } from "./tracks.js";

// session/own_pictures.h has the host's limits. Below them: a megabyte a picture, and three million bytes a second.
const most_pixels = 1920 * 1200, most_bytes = 1_000_000, bytes_per_ms = 2500;
const pictures_per_s = 8, best_quality = 0.85, least_quality = 0.4, again_every_ms = 500, refusal_ms = 10_000;

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
        const own = this.asked = {};  // a later question has another one
        let stream = null;
        try {
            stream = await navigator.mediaDevices.getDisplayMedia({ video: { frameRate: { max: 15 } }, audio: false });
            if (this.asked !== own)  // given up while the browser asked
                return stop_tracks(stream);
            this.stream = this.video.srcObject = stream;
            // The browser's own button ends it, too.
            stream.getVideoTracks()[0].addEventListener("ended", () => this.stream === stream && this.hide());
            await this.video.play();
        } catch {
            stop_tracks(stream);
            if (this.asked === own)
                this.refuse();
            return;
        }
        if (this.asked !== own)
            return;
        this.quality = best_quality;
        this.rests_until_ms = 0;
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
        stop_tracks(this.stream);
        this.clock = this.stream = this.video.srcObject = this.sent = this.asked = null;
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
        const { videoWidth, videoHeight } = this.video, { canvas } = this, begin = performance.now();
        if (this.is_taking || !videoWidth || !videoHeight || begin < this.rests_until_ms)
            return;
        this.is_taking = true;
        let jpeg = null;
        try {
            const to = canvas.getContext("2d");
            to.fillRect(0, 0, canvas.width, canvas.height);
            to.drawImage(this.video, ...place_within([videoWidth, videoHeight], [canvas.width, canvas.height]));
            jpeg = await (await canvas.convertToBlob({ type: "image/jpeg", quality: this.quality })).arrayBuffer();
        } catch (error) {
            console.log(`a picture of the screen is left out: ${error.message}`);  // the next one comes soon
        } finally {
            this.is_taking = false;
        }
        if (!jpeg || this.state !== "on" || canvas !== this.canvas ||
            (begin < this.sent_at_ms + again_every_ms && are_equal(this.sent, jpeg)))
            return;
        // The host would leave it out: the next one is coarser.
        if (jpeg.byteLength > most_bytes) {
            this.quality = Math.max(least_quality, this.quality - 0.15);
            return;
        }
        this.sent = jpeg;
        this.sent_at_ms = begin;
        this.rests_until_ms = begin + jpeg.byteLength / bytes_per_ms;
        put_bytes(this.module, jpeg);
        this.client.send_screen(1000 * (performance.now() - begin));
    }
}
