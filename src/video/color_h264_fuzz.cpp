// SPDX-License-Identifier: Apache-2.0
// Any bytes end in a status or in a picture of the size in their header. After any
// bytes a good key frame can be decoded.
#include <cstdlib>

#include "video/color_codec.h"
#include "video/h264_header.h"

namespace {

using namespace theatron;

Bytes good_key_frame() {
    ColorData color;
    color.size = {16, 16};
    color.pixels = ColorImage(color.size);
    const auto encoder = video::make_color_encoder(video::parse_color_setting("h264").setting);
    const auto encoded = encoder->encode(color, true);
    return Bytes(encoded->bytes.begin(), encoded->bytes.end());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto decoder = video::make_color_decoder(video::ColorCodecId::h264);
    static const Bytes key = good_key_frame();
    const auto input = std::as_bytes(std::span(data, size));
    const auto promised = video::read_h264_picture(input);
    // Larger pictures only make the search slow.
    if (promised && promised->size.area() > 1 << 14)
        return 0;
    if (decoder->submit(key, 6) != Status::ok)
        std::abort();
    decoder->recycle(std::move(decoder->poll()->image));
    const Status status = decoder->submit(input, 7);
    auto decoded = decoder->poll();
    if (decoded.has_value() != (status == Status::ok) || (decoded && !promised))
        std::abort();
    if (decoded) {
        if (decoded->frame != 7 || decoded->image.size != promised->size)
            std::abort();
        decoder->recycle(std::move(decoded->image));
    }
    return 0;
}
