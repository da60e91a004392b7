// SPDX-License-Identifier: Apache-2.0
// The header of a JPEG picture, before its pixels: enough to refuse the picture,
// to check its size and to reserve memory, without a JPEG library.
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "image/view.h"

namespace theatron::video {

// The size of the sequential Huffman-coded JPEG picture (grey or three
// components, eight bits, one scan) in `jpeg`. Safe for untrusted input. Refuses
//  - progressive, lossless and arithmetic-coded pictures and those of several
//    scans (unsupported): cameras give none, and decoding them needs time and
//    memory that a small hostile file can multiply at will;
//  - sizes beyond max_side (too_large);
//  - pictures with fewer bytes than their smallest coding (truncated).
Result<Size> read_jpeg_size(ByteView jpeg);

// Marker codes of ITU-T T.81, table B.1.
namespace jpeg_marker {
inline constexpr std::uint8_t temporary = 0x01, baseline = 0xc0, extended_sequential = 0xc1,
                              huffman_tables = 0xc4, jpeg_extension = 0xc8,
                              arithmetic_tables = 0xcc, first_restart = 0xd0, last_restart = 0xd7,
                              start_of_image = 0xd8, end_of_image = 0xd9, start_of_scan = 0xda,
                              quantization_tables = 0xdb, restart_interval = 0xdd, adobe = 0xee;
}  // namespace jpeg_marker

struct JpegSegment {
    std::uint8_t marker = 0;
    ByteView content;  // without marker and length
};

// Reads the marker segment that follows in `in`. Malformed if something else does.
Result<JpegSegment> next_jpeg_segment(ByteReader& in);

// T.81 fields are big-endian; the reader's are not.
inline std::uint16_t get_be16(ByteReader& in) {
    const auto high = in.get<std::uint8_t>();
    return std::uint16_t(high << 8 | in.get<std::uint8_t>());
}

}  // namespace theatron::video
