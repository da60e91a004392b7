// SPDX-License-Identifier: Apache-2.0
#include "video/jpeg_header.h"

namespace theatron::video {
namespace {

using namespace jpeg_marker;

bool is_start_of_frame(std::uint8_t marker) {
    return marker >= 0xc0 && marker <= 0xcf && marker != huffman_tables &&
           marker != jpeg_extension && marker != arithmetic_tables;
}

// Skips to the next marker's code: any number of 0xff, then the code.
std::uint8_t next_marker(ByteReader& in) {
    if (in.get<std::uint8_t>() != 0xff)
        return 0;
    std::uint8_t code = 0xff;
    while (in.ok() && code == 0xff)
        code = in.get<std::uint8_t>();
    return code;
}

struct FrameHeader {
    Size size;
    int components = 0;
};

Result<FrameHeader> read_frame_header(ByteReader in, std::size_t jpeg_bytes) {
    const auto bits = in.get<std::uint8_t>();
    FrameHeader frame;
    frame.size.height = get_be16(in);
    frame.size.width = get_be16(in);
    frame.components = in.get<std::uint8_t>();
    if (!in.ok())
        return Status::truncated;
    if (bits != 8 || (frame.components != 1 && frame.components != 3))
        return Status::unsupported;
    // A height of 0 refers to a DNL marker, which no known encoder writes.
    if (frame.size.width == 0 || frame.size.height == 0)
        return Status::malformed;
    if (!is_valid(frame.size))
        return Status::too_large;
    // Each 8x8 block takes at least two bits, one for DC and one for the end of block.
    if (jpeg_bytes < frame.size.area() / 256)
        return Status::truncated;
    return frame;
}

}  // namespace

Result<JpegSegment> next_jpeg_segment(ByteReader& in) {
    const std::uint8_t marker = next_marker(in);
    if (!in.ok())
        return Status::truncated;
    if (marker == 0 || marker == temporary || (marker >= first_restart && marker <= end_of_image))
        return Status::malformed;
    const std::uint16_t length = get_be16(in);
    if (in.ok() && length < 2)
        return Status::malformed;
    const ByteView content = in.get_bytes(length - 2u);
    if (!in.ok())
        return Status::truncated;
    return JpegSegment{marker, content};
}

Result<Size> read_jpeg_size(ByteView jpeg) {
    ByteReader in(jpeg);
    const std::uint8_t first = next_marker(in);
    if (!in.ok())
        return Status::truncated;
    if (first != start_of_image)
        return Status::malformed;

    FrameHeader frame;
    while (true) {
        const Result<JpegSegment> segment = next_jpeg_segment(in);
        if (!segment)
            return segment.error();
        const auto [marker, content] = *segment;

        if (marker == baseline || marker == extended_sequential) {
            if (frame.components > 0)
                return Status::malformed;
            const Result<FrameHeader> found = read_frame_header(ByteReader(content), jpeg.size());
            if (!found)
                return found.error();
            frame = *found;
        } else if (is_start_of_frame(marker)) {
            return Status::unsupported;
        } else if (marker == start_of_scan) {
            if (frame.components == 0)
                return Status::malformed;
            const int components = ByteReader(content).get<std::uint8_t>();
            if (components != frame.components)
                return Status::unsupported;
            return frame.size;
        }
    }
}

}  // namespace theatron::video
