// SPDX-License-Identifier: Apache-2.0
#include "video/h264_header.h"

namespace theatron::video {
namespace {

constexpr std::uint8_t version = 1;
constexpr std::uint8_t key_flag = 1;

}  // namespace

void put_h264_header(bool key, Size size, std::byte* out) {
    out[0] = std::byte(version);
    out[1] = std::byte(key ? key_flag : 0);
    store_le(out + 2, std::uint16_t(size.width));
    store_le(out + 4, std::uint16_t(size.height));
}

Result<H264Picture> read_h264_picture(ByteView payload) {
    ByteReader in(payload);
    const auto found_version = in.get<std::uint8_t>();
    const auto flags = in.get<std::uint8_t>();
    H264Picture picture;
    picture.key = flags == key_flag;
    picture.size.width = in.get<std::uint16_t>();
    picture.size.height = in.get<std::uint16_t>();
    picture.access_unit = in.rest();
    if (!in.ok() || picture.access_unit.empty())
        return Status::truncated;
    if (found_version > version)
        return Status::unsupported_version;
    if (found_version != version || flags > key_flag || picture.size.area() == 0)
        return Status::malformed;
    if (!is_valid(picture.size) || coded_size(picture.size).area() > avc::max_area)
        return Status::too_large;
    return picture;
}

}  // namespace theatron::video
