// SPDX-License-Identifier: Apache-2.0
#include "data_url.h"

#include "base/error.h"
#include "video/color_codec.h"

namespace theatron::bench {

std::string base64(ByteView bytes) {
    static constexpr char digits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = bytes.size() - i;
        const auto byte = [&](std::size_t k) {
            return k < left ? std::to_integer<unsigned>(bytes[i + k]) : 0u;
        };
        const unsigned bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= left ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string picture_url(const ColorImage& picture) {
    const auto encoder =
        video::make_color_encoder(video::parse_color_setting("jpeg:quality=85").setting);
    ColorData color;
    color.size = picture.size;
    color.pixels = picture;
    if (picture.empty())
        throw Error("A picture without pixels cannot be shown in a page.");
    const auto encoded = encoder->encode(color, true);
    if (!encoded)
        throw Error("A picture of the page could not be compressed.");
    return "data:image/jpeg;base64," + base64(encoded->bytes);
}

}  // namespace theatron::bench
