// SPDX-License-Identifier: Apache-2.0
// libopus as a WebAssembly module of its own, for a worker of the page (page/opus_worker.js) where
// the browser has no Opus. One packet or frame at a time, in memory that both sides know.
#include <emscripten/emscripten.h>

#include <algorithm>
#include <array>
#include <memory>

#include "voice/opus_codec.h"
#include "voice/packet.h"

namespace theatron::web {
namespace {

constexpr int frame_ms = 20;
constexpr std::size_t most_samples = frame_ms * voice::sample_rate / 1000;

std::array<std::byte, voice::max_opus_size> packet;
std::array<float, most_samples> samples;
std::unique_ptr<voice::Encoder> encoder;
Bytes encoded;

}  // namespace
}  // namespace theatron::web

using namespace theatron;

extern "C" {

// Where the bytes of the next packet belong, and its samples are; opus_most_bytes() and 960 at
// most.
EMSCRIPTEN_KEEPALIVE std::byte* opus_packet() {
    return web::packet.data();
}
EMSCRIPTEN_KEEPALIVE float* opus_samples() {
    return web::samples.data();
}
EMSCRIPTEN_KEEPALIVE unsigned opus_most_bytes() {
    return unsigned(web::packet.size());
}

EMSCRIPTEN_KEEPALIVE voice::Decoder* opus_open_decoder() {
    return new voice::Decoder;
}
EMSCRIPTEN_KEEPALIVE void opus_close_decoder(voice::Decoder* decoder) {
    delete decoder;
}
// Decodes the packet of `bytes` bytes. 0 if it is damaged or does not have `count` samples.
EMSCRIPTEN_KEEPALIVE int opus_decode_packet(voice::Decoder* decoder, unsigned bytes,
                                            unsigned count) {
    if (bytes == 0 || bytes > web::packet.size() || count == 0 || count > web::samples.size())
        return 0;
    return decoder->decode(ByteView(web::packet).first(bytes),
                           std::span(web::samples).first(count));
}

// The next frame begins a new stream.
EMSCRIPTEN_KEEPALIVE void opus_begin_encoder() {
    // The page finds silence itself, as with the browser's encoder.
    web::encoder = std::make_unique<voice::Encoder>(web::frame_ms, 32'000, false);
}
// Encodes the samples; returns the bytes of the packet.
EMSCRIPTEN_KEEPALIVE unsigned opus_encode_frame() {
    if (!web::encoder)
        return 0;
    (void)web::encoder->encode(web::samples, web::encoded);
    std::copy(web::encoded.begin(), web::encoded.end(), web::packet.begin());
    return unsigned(web::encoded.size());
}

}  // extern "C"
