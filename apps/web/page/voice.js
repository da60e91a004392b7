// SPDX-License-Identifier: Apache-2.0
// Voice: the others from where they stand, and one's own microphone. The packets are those of docs/formats/voice.md.
import { use_loudspeaker, wanted_device } from "./device_choice.js";
import { find_decoders, find_encoders, has_opus, sample_rate } from "./opus.js";
import { with_patience } from "./program.js";
import { stop_tracks } from "./tracks.js";

const header_size = 16, version = 1, most_opus_bytes = 1275;
const frame_us = 20_000;            // of the microphone
const speech_db = -50;              // a frame of this level counts as speech
const hang_over_ms = 400;           // speech goes on for so long behind the last such frame
const release_ms = 200;             // the key of push to talk is released before the last word ends
const most_speakers = 32;           // the one that was silent for longest makes room for another
const least_silence_ms = 1000;      // of one that makes room
const longest_silence_ms = 60_000;  // of a speaker that is kept

// The header of a packet, and its Opus frame; null if it is none.
export function parse_packet(bytes) {
    if (bytes.length <= header_size || bytes.length > header_size + most_opus_bytes)
        return null;
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    const frame_ms = view.getUint8(2);
    if (view.getUint8(0) !== version || view.getUint8(1) > 1 || (frame_ms !== 10 && frame_ms !== 20))
        return null;
    return { pauses: view.getUint8(1), frame_ms, level_db: -view.getUint8(3), number: view.getUint32(4, true),
             opus: bytes.subarray(header_size) };
}

function level_of(samples) {
    let sum = 0;
    for (const v of samples)
        sum += v * v;
    return Math.round(Math.min(0, Math.max(-127, 10 * Math.log10(Math.max(sum / samples.length, 1e-13)))));
}

// Jitter buffers on the audio thread. The browser gives the memory of one back late, so each serves one speaker after the other.
class Playouts {
    resting = [];
    made = 0;

    // Nothing while all are in use.
    take(context, program) {
        if (this.resting.length > 0)
            return this.resting.pop();
        if (this.made === most_speakers)
            return null;
        const node = new AudioWorkletNode(context, "speaker", {
            numberOfInputs: 0, outputChannelCount: [1], processorOptions: { program } });
        ++this.made;
        return node;
    }

    // Messages that are still on their way tell of the speaker before.
    give_back(node) {
        node.port.onmessage = ({ data }) => data === "rests" && this.resting.push(node);
        node.port.postMessage("rest");
        node.disconnect();
    }
}

// One of the others: decoder, jitter buffer, and a place in the room.
class Speaker {
    has_ended = false;
    figures = { level_db: -127, delay_ms: 0, seconds: 0, concealed_ms: 0 };
    newest_ms = 0;

    // `make_decoder` as find_decoders() has found it; `refused()` follows a damaged packet.
    constructor(context, node, make_decoder, refused) {
        this.node = node;
        this.node.port.onmessage = ({ data }) => this.figures = data;
        // Voices stay understandable across the room.
        this.panner = new PannerNode(context, {
            panningModel: "HRTF", distanceModel: "inverse", refDistance: 1.5, rolloffFactor: 0.5 });
        this.node.connect(this.panner).connect(context.destination);
        this.decoder = make_decoder({
            taken: (header, samples) =>
                this.has_ended || this.node.port.postMessage({ ...header, samples }, [samples.buffer]),
            refused });
    }

    put({ opus, ...header }) {
        this.newest_ms = performance.now();
        this.decoder.put(opus, header);
    }

    move(context, [x, y, z]) {
        const soon = context.currentTime + 0.05;
        for (const [axis, value] of [["positionX", x], ["positionY", y], ["positionZ", z]])
            this.panner[axis].linearRampToValueAtTime(value, soon);
    }

    end(playouts) {
        this.has_ended = true;
        playouts.give_back(this.node);
        this.panner.disconnect();
        this.decoder.close();
    }
}

export class Voice {
    // "off", "asking", "open", "denied" or "missing": of the microphone. `unreadable` packets were skipped.
    microphone = "off";
    problem = "";        // why nothing is heard: the browser's words
    unreadable = 0;
    pushes = false;      // push to talk: an open microphone is heard only while talk(true) holds
    hands_free = false;  // no key can be held: as if there were no push to talk
    is_held = false;
    released_ms = -Infinity;
    speakers = new Map();  // participant -> Speaker
    playouts = new Playouts();
    resume = () => this.context.resume();  // one function: visits without an act add no further listener

    // `send(number, age_us, pauses, level_db, opus)` sends a frame whose first sample is so old; `changed()` follows a
    // change of the microphone.
    constructor(send, changed) {
        this.send = send;
        this.changed = changed;
    }

    static is_supported() {
        return !!(globalThis.AudioContext && globalThis.AudioWorkletNode && has_opus());
    }

    // Asks for what nobody needs: the browser starts its process for sound beside the page, and begin() need not wait for it.
    static warm_up() {
        if (Voice.is_supported())
            navigator.mediaDevices?.enumerateDevices().catch(() => {});
    }

    // Call it in an event of the user: before one, browsers play nothing.
    async begin() {
        if (!Voice.is_supported())
            return;
        try {
            await this.open_sound();
            this.problem = "";
        } catch (error) {
            this.loaded = undefined;  // the next time asks again
            this.problem = error.message || error.name;
            throw error;
        }
    }

    async open_sound() {
        this.context ??= new AudioContext({ sampleRate: sample_rate, latencyHint: "interactive" });
        // A page that entered by itself, after its graphics were lost, is silent until somebody acts in it.
        if (this.context.state === "suspended")
            for (const act of ["pointerdown", "keydown"])
                addEventListener(act, this.resume, { once: true });
        const resumed = this.context.resume();
        this.loaded ??= Promise.all([
            with_patience(() => this.context.audioWorklet.addModule(new URL("./voice_worklet.js", import.meta.url))),
            with_patience(() => WebAssembly.compileStreaming(fetch(new URL("./voice.wasm", import.meta.url)))),
            find_decoders(),
        ]).then(([, program, make_decoder]) => {
            this.make_decoder = make_decoder;
            this.program = program;
        });
        await Promise.all([resumed, this.loaded, use_loudspeaker(this.context)]);
    }

    // Throws nothing: the program that calls it would lose its place.
    hear(id, bytes) {
        if (!this.program)
            return;
        try {
            const packet = parse_packet(bytes);
            if (packet)
                this.speaker(id)?.put(packet);
            else
                ++this.unreadable;
        } catch {
            ++this.unreadable;
        }
    }

    // Nothing if there is no room for another.
    speaker(id) {
        const known = this.speakers.get(id);
        if (known)
            return known;
        const node = this.make_room() ? this.playouts.take(this.context, this.program) : null;
        if (!node)
            return undefined;
        const speaker = new Speaker(this.context, node, this.make_decoder, () => ++this.unreadable);
        this.speakers.set(id, speaker);
        return speaker;
    }

    // Nobody who speaks makes room. So speakers are not made and forgotten with each packet, however many there are.
    make_room() {
        if (this.speakers.size < most_speakers)
            return true;
        const [[id, oldest]] = [...this.speakers].sort(([, a], [, b]) => a.newest_ms - b.newest_ms);
        if (performance.now() - oldest.newest_ms < least_silence_ms)
            return false;
        this.forget(id, oldest);
        return true;
    }
    forget(id, speaker) {
        speaker.end(this.playouts);
        this.speakers.delete(id);
    }

    // The listener's place (`eye`: position, ahead and up, each x y z) and those of the speakers by participant.
    place(eye, places) {
        if (!this.context)
            return;
        const { listener, currentTime } = this.context;
        const soon = currentTime + 0.05;
        const turn = (names, values) => names.forEach((name, i) => listener[name]?.linearRampToValueAtTime(values[i], soon));
        if (eye) {
            turn(["positionX", "positionY", "positionZ"], eye.position);
            turn(["forwardX", "forwardY", "forwardZ"], eye.ahead);
            turn(["upX", "upY", "upZ"], eye.up);
        }
        const now = performance.now();
        for (const [id, speaker] of this.speakers) {
            if (places.has(id))
                speaker.move(this.context, places.get(id));
            else if (now - speaker.newest_ms > longest_silence_ms)
                this.forget(id, speaker);
        }
    }

    is_speaking(id) {
        return (this.speakers.get(id)?.figures.level_db ?? -127) > speech_db;
    }

    async open_microphone() {
        if (this.microphone === "open" || this.microphone === "asking")
            return;
        this.set_microphone("asking");
        try {
            await this.begin();
            const make_encoder = await find_encoders();
            this.stream = await navigator.mediaDevices.getUserMedia({
                audio: { channelCount: 1, echoCancellation: true, noiseSuppression: true, autoGainControl: true,
                         ...wanted_device("microphone") } });
            if (this.microphone !== "asking")  // closed while the browser asked
                return this.stop_stream();
            this.stream.getAudioTracks()[0].addEventListener("ended", () => this.close_microphone("missing"));
            this.source = new MediaStreamAudioSourceNode(this.context, { mediaStream: this.stream });
            this.frames = new AudioWorkletNode(this.context, "microphone", { numberOfOutputs: 0, channelCount: 1,
                channelCountMode: "explicit" });
            this.begin_encoder(make_encoder);
            this.frames.port.onmessage = ({ data }) => this.encode(data);
            this.source.connect(this.frames);
            this.set_microphone("open");
        } catch (error) {
            this.close_microphone(this.problem ? "off" : error.name === "NotAllowedError" ? "denied" : "missing");
        }
    }

    close_microphone(why = "off") {
        this.source?.disconnect();
        this.frames?.disconnect();
        if (this.frames)
            this.frames.port.onmessage = null;
        this.encoder?.close();
        this.source = this.frames = this.encoder = null;
        this.stop_stream();
        this.set_microphone(why);
    }

    toggle_microphone() {
        return this.microphone === "open" || this.microphone === "asking" ? this.close_microphone() : this.open_microphone();
    }

    set_push_to_talk(pushes) {
        this.pushes = pushes;
        this.changed();
    }

    // The key or button of push to talk is held, or was released.
    talk(is_held) {
        if (this.is_held === is_held)
            return;
        this.is_held = is_held;
        if (!is_held)
            this.released_ms = performance.now();
        this.changed();
    }

    talks(now) {
        return !this.pushes || this.hands_free || this.is_held || now - this.released_ms < release_ms;
    }

    stop_stream() {
        stop_tracks(this.stream);
        this.stream = null;
    }

    set_microphone(state) {
        this.microphone = state;
        this.changed();
    }

    begin_encoder(make_encoder) {
        this.number ??= 0;
        this.spoke_ms = -Infinity;
        this.is_sending = false;
        this.encoder = make_encoder({
            made: ({ number, taken_ms, pauses, level_db }, opus) =>
                this.send(number, (performance.now() - taken_ms) * 1000 + frame_us, pauses, level_db, opus),
            failed: () => this.close_microphone("missing") });
    }

    // Silence is not sent; its frames are counted on, and the first one says that a pause begins.
    encode(samples) {
        const now = performance.now(), number = this.number++;
        const talks = this.talks(now);
        if (!talks)
            samples.fill(0);
        const level_db = level_of(samples);
        if (level_db > speech_db)
            this.spoke_ms = now;
        const is_voice = talks && now - this.spoke_ms < hang_over_ms;
        if (!is_voice && !this.is_sending)
            return;
        this.is_sending = is_voice;
        this.encoder.put(samples, { number: number >>> 0, taken_ms: now, pauses: is_voice ? 0 : 1, level_db });
    }

    leave() {
        this.close_microphone();
        for (const [id, speaker] of [...this.speakers])
            this.forget(id, speaker);
        this.context?.suspend();
    }
}
