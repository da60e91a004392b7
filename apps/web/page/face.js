// SPDX-License-Identifier: Apache-2.0
// The person's own webcam as a small picture on the head of the avatar: off until the person wants it.
import { wanted_device } from "./device_choice.js";
import { put_bytes } from "./program.js";
import { stop_tracks } from "./tracks.js";

const width = 320, height = 240, pictures_per_s = 10, quality = 0.75;

export class Face {
    // "off", "asking", "on", "denied" or "missing": of the webcam.
    state = "off";
    stream = null;
    video = document.createElement("video");
    is_taking = false;

    // The pictures are drawn into `canvas` and given to the client's program.
    constructor(canvas, module, client) {
        this.canvas = canvas;
        this.module = module;
        this.client = client;
        canvas.width = width;
        canvas.height = height;
        this.video.muted = this.video.playsInline = true;
    }

    async show() {
        if (this.state === "asking" || this.state === "on")
            return;
        this.state = "asking";
        let stream = null;
        try {
            stream = await navigator.mediaDevices.getUserMedia({
                video: { width: { ideal: 640 }, height: { ideal: 480 }, frameRate: { ideal: 15 }, ...wanted_device("webcam") } });
            this.video.srcObject = stream;
            await this.video.play();
        } catch (error) {
            stop_tracks(stream);
            if (this.state === "asking")
                this.hide(error.name === "NotAllowedError" ? "denied" : "missing");
            return;
        }
        if (this.state !== "asking")  // given up while the browser asked
            return stop_tracks(stream);
        this.stream = stream;
        stream.getVideoTracks()[0].addEventListener("ended", () => this.stream === stream && this.hide("missing"));
        this.state = "on";
        this.offer();
        this.timer = setInterval(() => this.take(), 1000 / pictures_per_s);
    }

    // Again for each connection of the client's program.
    offer() {
        if (this.state === "on")
            this.client.show_face(width, height, pictures_per_s);
    }

    hide(why = "off") {
        clearInterval(this.timer);
        stop_tracks(this.stream);
        this.stream = this.video.srcObject = null;
        if (this.state === "on")
            this.client.show_face(0, 0, 0);
        this.state = why;
    }

    async take() {
        const { videoWidth, videoHeight } = this.video;
        if (this.is_taking || !videoWidth || !videoHeight)
            return;
        this.is_taking = true;
        const begin = performance.now();
        // The middle of the video, as much of it as has this shape.
        const scale = Math.min(videoWidth / width, videoHeight / height);
        const [w, h] = [width * scale, height * scale];
        this.canvas.getContext("2d").drawImage(this.video, (videoWidth - w) / 2, (videoHeight - h) / 2, w, h, 0, 0, width, height);
        const blob = await new Promise(done => this.canvas.toBlob(done, "image/jpeg", quality));
        const jpeg = await blob?.arrayBuffer();
        this.is_taking = false;
        if (!jpeg || this.state !== "on")
            return;
        put_bytes(this.module, jpeg);
        this.client.send_face(1000 * (performance.now() - begin));
    }
}
