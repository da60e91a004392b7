// SPDX-License-Identifier: Apache-2.0
// libopus (apps/web/voice/opus_calls.cpp) for opus.js, in a worker: the page's thread does not wait for it. The first
// message has the compiled program. Each further one has the `id` of a decoder or an encoder, which begins with its first
// frame: a packet `opus` of `count` samples, or the `samples` of a frame; or it `ends`. Answers have samples or a packet,
// and neither for a packet that cannot be decoded.
let program, opus;
const decoders = new Map();  // id -> address
let encoding;                // the id whose encoder that is

function begin() {
    // The module asks the system for nothing that matters here.
    const imports = {};
    for (const { module, name } of WebAssembly.Module.imports(program))
        (imports[module] ??= {})[name] = () => 0;
    opus = new WebAssembly.Instance(program, imports).exports;
    opus._initialize?.();
    decoders.clear();
    encoding = undefined;
}

function decode(id, packet, count) {
    if (packet.length > opus.opus_most_bytes())
        return null;
    if (!decoders.has(id))
        decoders.set(id, opus.opus_open_decoder());
    new Uint8Array(opus.memory.buffer).set(packet, opus.opus_packet());
    return opus.opus_decode_packet(decoders.get(id), packet.length, count)
        ? new Float32Array(opus.memory.buffer, opus.opus_samples(), count).slice() : null;
}

function encode(id, samples) {
    if (encoding !== id)
        opus.opus_begin_encoder();
    encoding = id;
    new Float32Array(opus.memory.buffer, opus.opus_samples(), samples.length).set(samples);
    const size = opus.opus_encode_frame();
    return new Uint8Array(opus.memory.buffer, opus.opus_packet(), size).slice();
}

function end(id) {
    if (decoders.has(id))
        opus.opus_close_decoder(decoders.get(id));
    decoders.delete(id);
}

function answer({ id, frame, opus: packet, samples, count, ends }) {
    if (ends)
        return end(id);
    const result = packet ? { samples: decode(id, packet, count) } : { opus: encode(id, samples) };
    const [{ buffer } = {}] = Object.values(result).filter(Boolean);
    postMessage({ id, frame, ...result }, buffer ? [buffer] : []);
}

onmessage = ({ data }) => {
    if (data.program) {
        program = data.program;
        begin();
        return postMessage("ready");
    }
    try {
        answer(data);
    } catch {
        // Its memory may be damaged: all begin anew.
        begin();
        postMessage({ id: data.id, frame: data.frame });
    }
};
