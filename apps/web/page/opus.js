// SPDX-License-Identifier: Apache-2.0
// Opus for voice.js: by the browser's codecs, or where it has none, by libopus in a worker (opus_worker.js). The two
// directions are apart, since some browsers have one alone.
//
// A decoder has put(opus, frame) and close(). Its events: taken(frame, samples) in order, refused() for a damaged packet.
// An encoder has put(samples, frame) and close(). Its events: made(frame, opus) in order, failed(). `frame` is an object of
// the caller, which comes back; a decoder reads its number and frame_ms.
import { with_patience } from "./program.js";

export const sample_rate = 48000;
const sound = { codec: "opus", sampleRate: sample_rate, numberOfChannels: 1 };
const speech = { ...sound, bitrate: 32000,
                 opus: { application: "voip", frameDuration: 20000, useinbandfec: true, packetlossperc: 5 } };
const most_waiting = 50;  // frames in a decoder; more come faster than anybody speaks

// The packer gives the file another name; a page that was built without libopus has none.
const own_file = "./opus.wasm";
const has_own = !own_file.endsWith("/opus.wasm");

export function has_opus() {
    return has_own || !!(globalThis.AudioDecoder && globalThis.AudioEncoder);
}

async function knows(codec, settings) {
    try {
        return (await codec.isConfigSupported(settings)).supported;
    } catch {
        return false;  // the codec as a whole is missing, or its settings are none
    }
}

async function start_worker() {
    if (!has_own)
        throw new Error("this browser has no Opus");
    const program = await with_patience(() => WebAssembly.compileStreaming(fetch(new URL(own_file, import.meta.url))));
    const start_one = () => new Promise((resolve, reject) => {
        const worker = new Worker(new URL("./opus_worker.js", import.meta.url));
        worker.onmessage = () => resolve(worker);
        worker.onerror = event => reject(new Error(event.message ?? "a worker did not start"));
        worker.postMessage({ program });
    });
    return with_patience(start_one);
}

// Later calls get what the first one found.
function found_once(find) {
    let found;
    return () => found ??= find().catch(error => {
        found = undefined;
        throw error;
    });
}

// A function that makes a decoder with the given events.
export const find_decoders = found_once(async () => {
    if (await knows(globalThis.AudioDecoder, sound))
        return events => new BrowserDecoder(events);
    const users = new Users(await start_worker());
    return events => new OwnDecoder(users, events);
});

// The same for encoders.
export const find_encoders = found_once(async () => {
    if (await knows(globalThis.AudioEncoder, speech))
        return events => new BrowserEncoder(events);
    const users = new Users(await start_worker());
    return events => new OwnEncoder(users, events);
});

class BrowserDecoder {
    constructor(events) {
        this.events = events;
        this.begin();
    }

    begin() {
        this.waiting = [];  // frames in the decoder, in order
        this.decoder = new AudioDecoder({
            output: data => {
                const frame = this.waiting.shift();
                const samples = new Float32Array(data.numberOfFrames);
                data.copyTo(samples, { planeIndex: 0, format: "f32-planar" });
                data.close();
                if (frame && samples.length === frame.frame_ms * sample_rate / 1000)
                    this.events.taken(frame, samples);
                else
                    this.events.refused();
            },
            error: () => {
                this.events.refused();
                this.begin();
            },
        });
        this.decoder.configure(sound);
    }

    put(opus, frame) {
        // Behind a fault a browser closes a decoder first, and says so later.
        if (this.decoder.state === "closed" || this.decoder.decodeQueueSize >= most_waiting)
            return;
        if (this.waiting.length >= 2 * most_waiting) {
            this.decoder.close();
            this.begin();
        }
        this.waiting.push(frame);
        this.decoder.decode(new EncodedAudioChunk({
            type: "key", timestamp: frame.number * frame.frame_ms * 1000, data: opus }));
    }

    close() {
        if (this.decoder.state !== "closed")
            this.decoder.close();
    }
}

class BrowserEncoder {
    constructor({ made, failed }) {
        this.waiting = [];  // frames in the encoder, in order
        this.encoder = new AudioEncoder({
            output: chunk => {
                const frame = this.waiting.shift();
                if (!frame)
                    return;
                const opus = new Uint8Array(chunk.byteLength);
                chunk.copyTo(opus);
                made(frame, opus);
            },
            error: failed,
        });
        this.encoder.configure(speech);
    }

    put(samples, frame) {
        this.waiting.push(frame);
        this.encoder.encode(new AudioData({ format: "f32-planar", sampleRate: sample_rate, numberOfChannels: 1,
            numberOfFrames: samples.length, timestamp: frame.number * 20000, data: samples }));
    }

    close() {
        if (this.encoder.state === "configured")
            this.encoder.close();
    }
}

// A worker that libopus runs in, and those who get its answers.
class Users {
    users = new Map();  // id -> answer(message)
    newest = 0;

    constructor(worker) {
        this.worker = worker;
        worker.onmessage = ({ data }) => this.users.get(data.id)?.(data);
    }
    join(answer) {
        this.users.set(++this.newest, answer);
        return this.newest;
    }
    post(message, moved = []) {
        this.worker.postMessage(message, moved);
    }
    leave(id) {
        this.users.delete(id);
        this.post({ id, ends: true });
    }
}

class OwnDecoder {
    waiting = 0;

    constructor(users, { taken, refused }) {
        this.users = users;
        this.id = users.join(({ frame, samples }) => {
            --this.waiting;
            if (samples)
                taken(frame, samples);
            else
                refused();
        });
    }
    put(opus, frame) {
        if (this.waiting >= most_waiting)
            return;
        ++this.waiting;
        this.users.post({ id: this.id, frame, opus, count: frame.frame_ms * sample_rate / 1000 });
    }
    close() {
        this.users.leave(this.id);
    }
}

class OwnEncoder {
    constructor(users, { made, failed }) {
        this.users = users;
        this.id = users.join(({ frame, opus }) => opus ? made(frame, opus) : failed());
    }
    put(samples, frame) {
        this.users.post({ id: this.id, frame, samples }, [samples.buffer]);
    }
    close() {
        this.users.leave(this.id);
    }
}
