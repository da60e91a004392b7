// SPDX-License-Identifier: Apache-2.0
#include "video/color_raw.h"

#include <cassert>

namespace theatron::video::color_raw {
namespace {

constexpr std::uint8_t version = 1;
constexpr std::uint8_t layout_rgb8 = 0;
constexpr std::size_t header_size = 6;  // version, layout, width u16, height u16

}  // namespace

std::size_t encoded_size(Size size) {
    return header_size + size.area() * sizeof(Rgb);
}

void encode(ColorView image, std::span<std::byte> out) {
    assert(is_valid(image.size) && out.size() >= encoded_size(image.size));
    out[0] = std::byte(version);
    out[1] = std::byte(layout_rgb8);
    store_le(&out[2], std::uint16_t(image.size.width));
    store_le(&out[4], std::uint16_t(image.size.height));
    const std::size_t row_bytes = std::size_t(image.size.width) * sizeof(Rgb);
    for (int y = 0; y < image.size.height; ++y)
        std::memcpy(&out[header_size + std::size_t(y) * row_bytes], image.row(y), row_bytes);
}

Result<Size> read_size(ByteView encoded) {
    ByteReader in(encoded);
    const auto found_version = in.get<std::uint8_t>();
    const auto layout = in.get<std::uint8_t>();
    const Size size{in.get<std::uint16_t>(), in.get<std::uint16_t>()};
    if (!in.ok())
        return Status::truncated;
    if (found_version > version)
        return Status::unsupported_version;
    if (found_version != version || layout != layout_rgb8 || size.width == 0 || size.height == 0)
        return Status::malformed;
    if (!is_valid(size))
        return Status::too_large;
    if (encoded.size() < encoded_size(size))
        return Status::truncated;
    if (encoded.size() > encoded_size(size))
        return Status::trailing_bytes;
    return size;
}

Status decode(ByteView encoded, MutableColorView out) {
    const Result<Size> size = read_size(encoded);
    if (!size)
        return size.error();
    if (*size != out.size)
        return Status::size_mismatch;
    const std::size_t row_bytes = std::size_t(out.size.width) * sizeof(Rgb);
    for (int y = 0; y < out.size.height; ++y)
        std::memcpy(out.row(y), &encoded[header_size + std::size_t(y) * row_bytes], row_bytes);
    return Status::ok;
}

}  // namespace theatron::video::color_raw
