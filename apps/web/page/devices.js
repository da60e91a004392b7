// SPDX-License-Identifier: Apache-2.0
// The devices of the test call: which ones to use, and whether they work. Nothing is opened before the person asks.
import { can_choose_loudspeaker, choose_device, device_choice, use_loudspeaker, wanted_device } from "./device_choice.js";
import { text } from "./texts.js";
import { stop_tracks } from "./tracks.js";

const $ = id => document.getElementById(id);
const kinds = { microphone: "audioinput", loudspeaker: "audiooutput", webcam: "videoinput" };
const level_every_ms = 80, quietest_db = -60;
const voice_level = 20, voice_levels = 3;  // above the quietest; this number of them is a voice
const patient_levels = 75;                 // 6 s without a voice are worth a word
const look_every_ms = 700, dark = 8;       // of 255: the mean of a picture in which nothing is seen
const tone_hz = 440, tone_s = 0.8, tone_gain = 0.15;

export class DeviceCheck {
    stream = {};  // kind -> what is open

    // `chosen(kind)` follows the choice of another device.
    constructor(chosen) {
        this.chosen = chosen;
        $("choose_loudspeaker").hidden = !can_choose_loudspeaker();
        for (const kind of Object.keys(kinds))
            $(kind + "_choice").addEventListener("change", ({ target }) => this.choose(kind, target));
        for (const kind of ["microphone", "webcam"])
            $("test_" + kind).addEventListener("click", () => this.toggle(kind));
        $("test_tone").addEventListener("click", () => this.play_tone());
        for (const [button, key] of [["heard_tone", "tone_heard"], ["missed_tone", "tone_missed"]])
            $(button).addEventListener("click", () => this.note_tone(key));
        navigator.mediaDevices?.addEventListener?.("devicechange", () => this.list());
        this.show();
    }

    begin() {
        const has_devices = !!navigator.mediaDevices?.getUserMedia;
        for (const kind of ["microphone", "webcam"]) {
            $("test_" + kind).disabled = !has_devices;
            this.tell(kind, has_devices ? "" : "no_devices");
        }
        this.tell("loudspeaker", "");
        return this.list();
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
        this.chosen(kind);
    }

    toggle(kind) {
        return this.stream[kind] ? this.end(kind) : this.open(kind);
    }

    async open(kind) {
        this.end(kind);
        const asked = this.stream[kind] = {};  // until the browser answers
        this.tell(kind, "device_asking");
        try {
            const device = wanted_device(kind);
            const stream = await navigator.mediaDevices.getUserMedia(kind === "microphone"
                ? { audio: { channelCount: 1, echoCancellation: true, ...device } } : { video: { width: { ideal: 640 }, ...device } });
            if (this.stream[kind] !== asked)  // given up meanwhile
                return stop_tracks(stream);
            this.stream[kind] = stream;
            stream.getTracks()[0].addEventListener("ended", () => this.stream[kind] === stream && this.lose(kind, "device_missing"));
            if (kind === "microphone")
                await this.measure(stream);
            else
                await this.preview(stream);
            await this.list();
        } catch (error) {
            // Another try may have begun, or the test call was closed.
            if (this.stream[kind] === asked || this.stream[kind]?.getTracks)
                this.lose(kind, error.name === "NotAllowedError" ? "device_denied" : "device_missing");
        }
        this.show();
    }

    lose(kind, why) {
        this.end(kind);
        this.tell(kind, why);
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
            clearInterval(this.looks);
            $("preview").srcObject = null;
        }
        this.tell(kind, "");
        this.show();
    }

    // All of them, before the room opens its own, and where the test call is put away.
    close() {
        for (const kind of Object.keys(this.stream))
            this.end(kind);
        this.context?.close();
        this.context = null;
        $("tone_question").hidden = true;
    }

    async sound() {
        this.context ??= new AudioContext();
        await Promise.all([this.context.resume(), use_loudspeaker(this.context)]);
        return this.context;
    }

    async measure(stream) {
        const context = await this.sound();
        if (this.stream.microphone !== stream)
            return;
        const analyser = new AnalyserNode(context, { fftSize: 2048 });
        this.source = new MediaStreamAudioSourceNode(context, { mediaStream: stream });
        this.source.connect(analyser);
        const samples = new Float32Array(analyser.fftSize);
        let levels = 0, loud = 0;
        clearInterval(this.timer);
        this.timer = setInterval(() => {
            analyser.getFloatTimeDomainData(samples);
            const mean = samples.reduce((sum, v) => sum + v * v, 0) / samples.length;
            const level = Math.max(0, 10 * Math.log10(mean + 1e-12) - quietest_db);
            $("level").value = level;
            ++levels;
            loud += level > voice_level;
            this.tell("microphone", loud >= voice_levels ? "microphone_hears" : levels > patient_levels ? "microphone_silent" : "microphone_listens");
        }, level_every_ms);
    }

    async preview(stream) {
        $("preview").srcObject = stream;
        await $("preview").play();
        if (this.stream.webcam !== stream)
            return;
        clearInterval(this.looks);
        this.looks = setInterval(() => this.tell("webcam", is_dark($("preview")) ? "webcam_dark" : "webcam_shows"), look_every_ms);
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
            this.tell("loudspeaker", "");
            $("tone_question").hidden = false;
        } catch (error) {
            $("tone_question").hidden = true;
            this.tell("loudspeaker", "tone_failed", { why: error.message });
        }
    }

    note_tone(key) {
        $("tone_question").hidden = true;
        this.tell("loudspeaker", key);
        $("test_tone").focus();
    }

    // A screen reader reads it when it changes.
    tell(kind, key, values) {
        const sentence = key ? text(key, values) : "";
        if ($(kind + "_says").textContent !== sentence)
            $(kind + "_says").textContent = sentence;
    }

    show() {
        const { microphone, webcam } = this.stream;
        for (const [button, is_open] of [["test_microphone", !!microphone], ["test_webcam", !!webcam]])
            $(button).setAttribute("aria-pressed", String(is_open));
        $("preview").hidden = !$("preview").srcObject;
    }
}

// A lens behind a shutter gives pictures, too.
function is_dark(video) {
    const canvas = Object.assign(document.createElement("canvas"), { width: 16, height: 12 });
    const to = canvas.getContext("2d");
    to.drawImage(video, 0, 0, canvas.width, canvas.height);
    const { data } = to.getImageData(0, 0, canvas.width, canvas.height);
    return data.reduce((sum, value, i) => sum + (i % 4 === 3 ? 0 : value), 0) / (canvas.width * canvas.height * 3) < dark;
}
