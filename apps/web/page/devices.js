// SPDX-License-Identifier: Apache-2.0
// The check of devices in the join form: which ones to use, and whether they work. Nothing is opened before the person asks.
import { can_choose_loudspeaker, choose_device, device_choice, use_loudspeaker, wanted_device } from "./device_choice.js";
import { text } from "./texts.js";
import { stop_tracks } from "./tracks.js";

const $ = id => document.getElementById(id);
const kinds = { microphone: "audioinput", loudspeaker: "audiooutput", webcam: "videoinput" };
const level_every_ms = 80, quietest_db = -60;
const tone_hz = 440, tone_s = 0.8, tone_gain = 0.15;

export class DeviceCheck {
    stream = {};  // kind -> what is open

    constructor() {
        $("choose_loudspeaker").hidden = !can_choose_loudspeaker();
        for (const kind of Object.keys(kinds))
            $(kind + "_choice").addEventListener("change", ({ target }) => this.choose(kind, target));
        $("test_microphone").addEventListener("click", () => this.toggle("microphone"));
        $("test_webcam").addEventListener("click", () => this.toggle("webcam"));
        $("test_tone").addEventListener("click", () => this.play_tone());
        navigator.mediaDevices?.addEventListener?.("devicechange", () => this.list());
        $("devices").addEventListener("toggle", () => $("devices").open ? this.list() : this.close());
        this.show();
    }

    // The names come with the permission; before it there is the usual device, and the one that was chosen before.
    async list() {
        const all = await navigator.mediaDevices?.enumerateDevices().catch(() => []) ?? [];
        for (const [kind, browser_kind] of Object.entries(kinds)) {
            const chosen = device_choice(kind);
            const named = all.filter(d => d.kind === browser_kind && d.label && !["default", "communications"].includes(d.deviceId))
                .map(({ deviceId, label }) => ({ id: deviceId, label }));
            if (chosen && !named.some(({ id }) => id === chosen.id))
                named.push(chosen);
            const place = $(kind + "_choice");
            place.replaceChildren(new Option(text("usual_device"), ""), ...named.map(({ id, label }) => new Option(label, id)));
            place.value = chosen?.id ?? "";
        }
    }

    choose(kind, place) {
        choose_device(kind, place.value ? { id: place.value, label: place.selectedOptions[0].textContent } : null);
        if (this.stream[kind])
            this.open(kind);  // the test goes on with this one
        else if (kind === "loudspeaker" && this.context)
            use_loudspeaker(this.context);
    }

    toggle(kind) {
        return this.stream[kind] ? this.end(kind) : this.open(kind);
    }

    async open(kind) {
        this.end(kind);
        const asked = this.stream[kind] = {};  // until the browser answers
        this.tell("device_asking");
        try {
            const device = wanted_device(kind);
            const stream = await navigator.mediaDevices.getUserMedia(kind === "microphone"
                ? { audio: { channelCount: 1, echoCancellation: true, ...device } } : { video: { width: { ideal: 640 }, ...device } });
            if (this.stream[kind] !== asked)  // given up meanwhile
                return stop_tracks(stream);
            this.stream[kind] = stream;
            this.tell("");
            if (kind === "microphone")
                await this.measure(stream);
            else
                await this.preview(stream);
            await this.list();
        } catch (error) {
            if (this.stream[kind] === asked)
                this.tell(error.name === "NotAllowedError" ? "device_denied" : "device_missing");
            if (this.stream[kind])
                this.end(kind);
        }
        this.show();
    }

    end(kind) {
        stop_tracks(this.stream[kind]);
        delete this.stream[kind];
        if (kind === "microphone") {
            clearInterval(this.timer);
            this.source?.disconnect();
            this.source = null;
            $("level").value = 0;
        } else {
            $("preview").srcObject = null;
        }
        this.show();
    }

    // All of them, before the room opens its own, and where the check is put away.
    close() {
        for (const kind of Object.keys(this.stream))
            this.end(kind);
        this.context?.close();
        this.context = null;
        this.tell("");
    }

    async sound() {
        this.context ??= new AudioContext();
        await Promise.all([this.context.resume(), use_loudspeaker(this.context)]);
        return this.context;
    }

    async measure(stream) {
        const context = await this.sound();
        const analyser = new AnalyserNode(context, { fftSize: 2048 });
        this.source = new MediaStreamAudioSourceNode(context, { mediaStream: stream });
        this.source.connect(analyser);
        const samples = new Float32Array(analyser.fftSize);
        clearInterval(this.timer);
        this.timer = setInterval(() => {
            analyser.getFloatTimeDomainData(samples);
            const mean = samples.reduce((sum, v) => sum + v * v, 0) / samples.length;
            $("level").value = Math.max(0, 10 * Math.log10(mean + 1e-12) - quietest_db);
        }, level_every_ms);
    }

    async preview(stream) {
        $("preview").srcObject = stream;
        await $("preview").play();
    }

    async play_tone() {
        try {
            const context = await this.sound(), begin = context.currentTime;
            const gain = new GainNode(context, { gain: 0 }), tone = new OscillatorNode(context, { frequency: tone_hz });
            tone.connect(gain).connect(context.destination);
            for (const [at_s, value] of [[0.05, tone_gain], [tone_s - 0.1, tone_gain], [tone_s, 0]])
                gain.gain.linearRampToValueAtTime(value, begin + at_s);
            tone.start();
            tone.stop(begin + tone_s);
            this.tell("tone_played");
        } catch (error) {
            this.tell("tone_failed", { why: error.message });
        }
    }

    tell(key, values) {
        $("device_hint").textContent = key ? text(key, values) : "";
    }

    show() {
        const { microphone, webcam } = this.stream;
        for (const [button, is_open] of [["test_microphone", !!microphone], ["test_webcam", !!webcam]])
            $(button).setAttribute("aria-pressed", String(is_open));
        $("preview").hidden = !$("preview").srcObject;
    }
}
