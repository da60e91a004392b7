// SPDX-License-Identifier: Apache-2.0
// The functions that page/decoding.js calls for its decoding workers, and page/decoder.js in them.
#include <emscripten/emscripten.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "base/steady_clock.h"
#include "client/decoder_pool_web.h"
#include "client/decoder_worker_web.h"
#include "codec/depth_stream.h"
#include "visit.h"

// `post_work` is set by page/decoding.js, `post_reply` by page/decoder.js.
EM_JS(void, theatron_post_work, (unsigned worker, const void* data, unsigned size),
      { Module.post_work(worker, HEAPU8.slice(data, data + size)); });
EM_JS(void, theatron_post_reply, (const void* data, unsigned size),
      { Module.post_reply(HEAPU8.slice(data, data + size)); });

using namespace theatron;
using theatron::web::page;

namespace {

codec::DepthSetting strata() {
    return codec::parse_depth_setting("strata").setting;
}

double fastest_ms(ByteView key_frame, int passes) {
    codec::DepthStreamDecoder decoder(strata());
    const Result<Size> size = decoder.read_size(key_frame);
    if (!size)
        return -1;
    codec::FrameLink key;
    key.key = true;
    DepthImage decoded(*size);
    double fastest = 1e9;
    for (int i = 0; i < passes; ++i) {
        const TimePoint begin = steady_now();
        if (decoder.decode(key, key_frame, decoded.view()) != Status::ok)
            return -1;
        fastest = std::min(fastest, to_ms(steady_now() - begin));
    }
    return fastest;
}

DepthImage hilly(Size size) {
    DepthImage image(size);
    std::minstd_rand random(1);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const double hills = 2000 + 600 * std::sin(x / 60.) + 400 * std::cos(y / 45.);
            const bool is_hole = (x / 40 + y / 40) % 7 == 0;
            image.view().row(y)[x] = is_hole ? 0 : std::uint16_t(hills + double(random() >> 8 & 7));
        }
    return image;
}

}  // namespace

extern "C" {

// Decoding workers are ready; before theatron_join().
EMSCRIPTEN_KEEPALIVE void theatron_use_decoders(int count) {
    client::decoder_pool().count = unsigned(count);
    client::decoder_pool().post = [](unsigned worker, ByteView message) {
        theatron_post_work(worker, message.data(), unsigned(message.size()));
    };
}

// A decoding worker's reply.
EMSCRIPTEN_KEEPALIVE void theatron_decoded(int worker) {
    if (const auto& on_reply = client::decoder_pool().on_reply)
        web::guarded([&] { on_reply(unsigned(worker), page().bytes); });
}

// In a decoding worker, whose clock has this difference in milliseconds from the page's clock.
EMSCRIPTEN_KEEPALIVE void theatron_begin_decoder(double clock_difference) {
    client::begin_decoder_worker(
        Duration(std::int64_t(clock_difference * 1000)),
        [](ByteView reply) { theatron_post_reply(reply.data(), unsigned(reply.size())); });
}

// In a decoding worker, a message of the page.
EMSCRIPTEN_KEEPALIVE void theatron_decode() {
    client::on_decoder_work(page().bytes);
}

// For measurements: milliseconds for a key frame of Strata, the fastest of these passes; below 0 if
// it cannot be decoded.
EMSCRIPTEN_KEEPALIVE double theatron_time_strata(int passes) {
    return fastest_ms(page().bytes, passes);
}

// The same for a picture of this size that is made here: hills with holes and a camera's noise.
EMSCRIPTEN_KEEPALIVE double theatron_time_depth(int width, int height, int passes) {
    const DepthImage hills = hilly({width, height});
    codec::DepthStreamEncoder encoder(strata());
    std::vector<std::byte> encoded(encoder.max_encoded_size(hills.size));
    encoded.resize(encoder.encode(hills.view(), 0, true, encoded).bytes);
    return fastest_ms(encoded, passes);
}

}  // extern "C"
