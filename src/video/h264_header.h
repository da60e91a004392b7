// SPDX-License-Identifier: Apache-2.0
// The six bytes before a colour picture in H.264 (docs/formats/color_h264.md).
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "video/avc_stream.h"

namespace theatron::video {

struct H264Picture {
    bool key = false;
    Size size;             // of the picture shown; the coded one has even sides
    ByteView access_unit;  // as avc::read_access_unit takes it
};

inline constexpr std::size_t h264_header_size = 6;

// Writes h264_header_size bytes.
void put_h264_header(bool key, Size size, std::byte* out);

// Takes a payload apart. Safe for untrusted input; the size is valid and at most
// avc::max_area. The access unit is not looked at.
Result<H264Picture> read_h264_picture(ByteView payload);

// The sides of the coded picture.
constexpr Size coded_size(Size shown) {
    return {shown.width + shown.width % 2, shown.height + shown.height % 2};
}

}  // namespace theatron::video
