// SPDX-License-Identifier: Apache-2.0
// On the browser's audio thread: the microphone's samples in frames, and one speaker's jitter buffer.

const frame_samples = 960;  // 20 ms at 48 kHz

// Posts each frame of the microphone as a Float32Array.
class Microphone extends AudioWorkletProcessor {
    frame = new Float32Array(frame_samples);
    filled = 0;

    process([input]) {
        const samples = input[0];
        for (let taken = 0; samples && taken < samples.length;) {
            const count = Math.min(samples.length - taken, frame_samples - this.filled);
            this.frame.set(samples.subarray(taken, taken + count), this.filled);
            taken += count;
            this.filled += count;
            if (this.filled === frame_samples) {
                this.port.postMessage(this.frame, [this.frame.buffer]);
                this.frame = new Float32Array(frame_samples);
                this.filled = 0;
            }
        }
        return true;
    }
}

// Plays the frames of one speaker: {number, frame_ms, pauses, level_db, samples} each, until "rest". It answers "rests", says
// nothing of that speaker any more, and plays another one from the next frame on.
class Speaker extends AudioWorkletProcessor {
    rests = true;
    next_figures = 0;

    constructor({ processorOptions: { program } }) {
        super();
        // The module asks the system for nothing that matters here.
        const imports = {};
        for (const { module, name } of WebAssembly.Module.imports(program))
            (imports[module] ??= {})[name] = () => 0;
        this.playout = new WebAssembly.Instance(program, imports).exports;
        this.playout._initialize?.();
        this.port.onmessage = ({ data }) => this.take(data);
    }

    now_us() {
        return currentTime * 1e6;
    }

    take(frame) {
        if (frame === "rest") {
            this.rests = true;
            this.playout.voice_begin();
            this.port.postMessage("rests");
            return;
        }
        this.rests = false;
        const { number, frame_ms, pauses, level_db, samples } = frame;
        new Float32Array(this.playout.memory.buffer, this.playout.voice_frame(), frame_samples).set(samples);
        this.playout.voice_put(number, frame_ms, pauses, level_db, this.now_us());
    }

    process(_, [output]) {
        if (this.rests)
            return true;
        const samples = output[0];
        const place = this.playout.voice_pull(samples.length, this.now_us());
        samples.set(new Float32Array(this.playout.memory.buffer, place, samples.length));
        if (currentTime >= this.next_figures) {
            this.next_figures = currentTime + 0.1;
            this.port.postMessage({
                level_db: this.playout.voice_level_db(),
                delay_ms: this.playout.voice_delay_ms(),
                seconds: this.playout.voice_samples() / 48000,
                concealed_ms: this.playout.voice_concealed() / 48,
            });
        }
        return true;
    }
}

registerProcessor("microphone", Microphone);
registerProcessor("speaker", Speaker);
