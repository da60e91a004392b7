// SPDX-License-Identifier: Apache-2.0
// The jitter buffer of one speaker as a WebAssembly module of its own, for the page's audio thread
// (page/voice_worklet.js). The browser has decoded the frames already.
#include <emscripten/emscripten.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <utility>

#include "voice/playout.h"

namespace theatron::web {
namespace {

constexpr std::size_t most_samples = 960;  // of one frame: 20 ms

// A frame's bytes are its samples.
class DecodedFrames : public voice::FrameDecoder {
public:
    bool decode(ByteView frame, std::span<float> out) override {
        if (frame.size() != out.size_bytes() || out.size() > most_samples)
            return false;
        std::memcpy(out.data(), frame.data(), frame.size());
        keep(out);
        return true;
    }
    bool recover(ByteView, std::span<float> out) override {
        conceal(out);
        return false;
    }
    // The last frame backwards, so that the samples join, and quieter each time.
    void conceal(std::span<float> out) override {
        for (std::size_t i = 0; i < out.size(); ++i) {
            const float gain = 1 - 0.5f * float(i + 1) / float(out.size());
            out[i] = i < size_ ? gain * last_[size_ - 1 - i] : 0;
        }
        keep(out);
    }

private:
    void keep(std::span<const float> out) {
        size_ = std::min(out.size(), most_samples);
        std::copy_n(out.begin(), size_, last_.begin());
    }
    std::array<float, most_samples> last_{};
    std::size_t size_ = 0;
};

// One speaker after the other.
struct Speaker {
    DecodedFrames decoder;
    voice::Playout playout{decoder};
};

std::optional<Speaker> speaker{std::in_place};
std::array<float, most_samples> frame, samples;

}  // namespace
}  // namespace theatron::web

using namespace theatron;

extern "C" {

// Forgets the speaker before; the next frame is of another one.
EMSCRIPTEN_KEEPALIVE void voice_begin() {
    web::speaker.emplace();
}
// Where the samples of the next frame belong, most_samples of them at most.
EMSCRIPTEN_KEEPALIVE float* voice_frame() {
    return web::frame.data();
}
// A frame has arrived: its packet's number, 10 or 20 ms, and the rest of its header.
EMSCRIPTEN_KEEPALIVE void voice_put(std::uint32_t number, int frame_ms, int pauses, int level_db,
                                    double now_us) {
    if (frame_ms != 10 && frame_ms != 20)
        return;
    voice::Packet packet;
    packet.number = number;
    packet.frame_ms = frame_ms;
    packet.pauses = pauses != 0;
    packet.level_db = level_db;
    packet.opus = std::as_bytes(std::span(web::frame).first(packet.samples()));
    web::speaker->playout.put(packet, from_us(std::int64_t(now_us)));
}
// The next `count` samples, most_samples at most, to be heard from `now_us` on.
EMSCRIPTEN_KEEPALIVE float* voice_pull(int count, double now_us) {
    const auto size = std::size_t(std::clamp(count, 0, int(web::most_samples)));
    web::speaker->playout.pull(std::span(web::samples).first(size), from_us(std::int64_t(now_us)));
    return web::samples.data();
}
EMSCRIPTEN_KEEPALIVE int voice_level_db() {
    return web::speaker->playout.level_db();
}
EMSCRIPTEN_KEEPALIVE double voice_delay_ms() {
    return double(web::speaker->playout.delay().count()) / 1000;
}
EMSCRIPTEN_KEEPALIVE double voice_samples() {
    return double(web::speaker->playout.figures().samples);
}
EMSCRIPTEN_KEEPALIVE double voice_concealed() {
    return double(web::speaker->playout.figures().concealed);
}

}  // extern "C"
