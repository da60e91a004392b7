// SPDX-License-Identifier: Apache-2.0
#include "bench_web_decoding.h"

#include <hwy/highway.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/steady_clock.h"
#include "capture/camera.h"
#include "codec/depth_stream.h"

namespace theatron::bench {
namespace {

constexpr int passes = 40;

DepthImage usual_picture() {
    const auto camera =
        capture::open_camera("synthetic:seconds=2,fps=30,loop=1,preload=1,quality=quick");
    for (int tries = 0; tries < 100; ++tries)
        if (const capture::Capture next = camera->next(100ms);
            next.kind == capture::Capture::Kind::frame)
            return next.frame->depth;
    throw Error("The generated camera gives no picture.");
}

std::string hex(ByteView bytes) {
    constexpr char digits[] = "0123456789abcdef";
    std::string text;
    for (const std::byte byte : bytes) {
        text += digits[std::size_t(byte) >> 4];
        text += digits[std::size_t(byte) & 15];
    }
    return text;
}

double fastest_native_ms(const codec::DepthSetting& setting, const codec::EncodedDepth& link,
                         ByteView encoded, Size size) {
    codec::DepthStreamDecoder decoder(setting);
    DepthImage decoded(size);
    double fastest = 1e9;
    for (int i = 0; i < passes; ++i) {
        const TimePoint begin = steady_now();
        if (decoder.decode(link, encoded, decoded.view()) != Status::ok)
            throw Error("Strata does not decode what it encoded.");
        fastest = std::min(fastest, to_ms(steady_now() - begin));
    }
    return fastest;
}

}  // namespace

nlohmann::json time_strata(BrowserPage& page) {
    const DepthImage picture = usual_picture();
    const codec::DepthSetting setting = codec::parse_depth_setting("strata").setting;
    codec::DepthStreamEncoder encoder(setting);
    std::vector<std::byte> encoded(encoder.max_encoded_size(picture.size));
    const codec::EncodedDepth link = encoder.encode(picture.view(), 0, true, encoded);
    encoded.resize(link.bytes);

    double native = 0;
    if (const std::int64_t sse4 = hwy::SupportedTargets() & HWY_SSE4; sse4 != 0) {
        hwy::SetSupportedTargetsForTest(sse4);
        native = fastest_native_ms(setting, link, encoded, picture.size);
        hwy::SetSupportedTargetsForTest(0);
    }
    const double web = page.evaluate("theatron.time_strata('" + hex(encoded) + "', " +
                                     std::to_string(passes) + ")")
                           .get<double>();
    if (web < 0)
        throw Error("The page does not decode Strata.");
    return {{"strata_decode_ms", web},
            {"native_sse4_decode_ms", native},
            {"strata_decode_over_native_sse4", native > 0 ? web / native : 0}};
}

}  // namespace theatron::bench
