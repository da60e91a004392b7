// SPDX-License-Identifier: Apache-2.0
#include "video/jpeg_header.h"

namespace theatron::video {
namespace {

// Marker codes of ITU-T T.81, table B.1.
constexpr std::uint8_t start_of_image = 0xd8, end_of_image = 0xd9, start_of_scan = 0xda;
constexpr std::uint8_t huffman_tables = 0xc4, jpeg_extension = 0xc8, arithmetic_tables = 0xcc;
constexpr std::uint8_t baseline = 0xc0, extended_sequential = 0xc1;
constexpr std::uint8_t temporary = 0x01, first_restart = 0xd0;

// T.81 fields are big-endian; the reader's are not.
std::uint16_t get_be16(ByteReader& in) {
    const auto high = in.get<std::uint8_t>();
    return std::uint16_t(high << 8 | in.get<std::uint8_t>());
}

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
    // A height of 0 means "see the DNL marker", which nobody writes.
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

Result<Size> read_jpeg_size(ByteView jpeg) {
    ByteReader in(jpeg);
    const std::uint8_t first = next_marker(in);
    if (!in.ok())
        return Status::truncated;
    if (first != start_of_image)
        return Status::malformed;

    FrameHeader frame;
    while (true) {
        const std::uint8_t marker = next_marker(in);
        if (!in.ok())
            return Status::truncated;
        if (marker == 0 || marker == temporary ||
            (marker >= first_restart && marker <= end_of_image))
            return Status::malformed;

        const std::uint16_t length = get_be16(in);
        if (in.ok() && length < 2)
            return Status::malformed;
        ByteReader segment(in.get_bytes(length - 2u));
        if (!in.ok())
            return Status::truncated;

        if (marker == baseline || marker == extended_sequential) {
            if (frame.components > 0)
                return Status::malformed;
            const Result<FrameHeader> found = read_frame_header(segment, jpeg.size());
            if (!found)
                return found.error();
            frame = *found;
        } else if (is_start_of_frame(marker)) {
            return Status::unsupported;
        } else if (marker == start_of_scan) {
            if (frame.components == 0)
                return Status::malformed;
            const int components = segment.get<std::uint8_t>();
            if (components != frame.components)
                return Status::unsupported;
            return frame.size;
        }
    }
}

}  // namespace theatron::video
