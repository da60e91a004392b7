// SPDX-License-Identifier: Apache-2.0
// Any text for a codec, as a receiver asks for one: a setting that spells and reads back as itself
// and with which a small picture is encoded, or a sentence.
#include <cstdlib>
#include <string_view>

#include "video/color_codec.h"
#include "video/depth_codecs.h"

namespace {

using namespace theatron;

void check_depth(std::string_view text) {
    const auto parsed = video::parse_depth_setting(text);
    if (!parsed.problem.empty())
        return;
    const auto again = video::parse_depth_setting(parsed.setting.text);
    if (!again.problem.empty() || again.setting != parsed.setting)
        std::abort();
    // A video library's encoder takes long to begin, and has a target of its own.
    if (parsed.setting.id == codec::DepthCodecId::h264)
        return;
    codec::DepthStreamEncoder encoder = video::make_depth_encoder(parsed.setting);
    codec::DepthStreamDecoder decoder = video::make_depth_decoder(parsed.setting);
    DepthImage image({16, 8}), decoded(image.size);
    Bytes bytes(encoder.max_encoded_size(image.size));
    for (FrameNumber frame = 0; frame < 3; ++frame) {
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            image.pixels[i] = std::uint16_t(i % 7 == 0 ? 0 : 1000 + i * (frame + 1));
        const auto encoded = encoder.encode(image.view(), frame, false, bytes);
        if (encoded.bytes > bytes.size() ||
            decoder.decode(
                {frame, encoded.reference_frame, std::uint8_t(encoded.layer), encoded.key},
                ByteView(bytes).first(encoded.bytes), decoded.view()) != Status::ok)
            std::abort();
    }
}

void check_color(std::string_view text) {
    const auto parsed = video::parse_color_setting(text);
    if (!parsed.problem.empty())
        return;
    const auto again = video::parse_color_setting(parsed.setting.text);
    if (!again.problem.empty() || again.setting != parsed.setting)
        std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    check_depth(text);
    check_color(text);
    return 0;
}
