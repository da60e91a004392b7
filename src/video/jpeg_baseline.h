// SPDX-License-Identifier: Apache-2.0
// The marker segments of the JPEG pictures that our own decoder takes, checked
// and in one piece. Both the fast decoder and its reference start from here.
#pragma once

#include <array>

#include "base/bytes.h"
#include "base/status.h"
#include "image/view.h"

namespace theatron::video {

// A Huffman code as ITU-T T.81 defines it: how many codes of each length from 1
// to 16 there are, and their symbols in order. Never over-subscribed.
struct JpegHuffmanCode {
    ByteView counts;  // 16
    ByteView symbols;
    bool defined() const { return !counts.empty(); }
};

struct JpegComponent {
    std::array<std::uint8_t, 64> steps{};  // of quantisation, in zigzag order
    JpegHuffmanCode dc, ac;
};

// Three components, luma first. A unit of coding is (1 << shift_x) x (1 << shift_y)
// blocks of luma and one of each chroma. Views refer to the picture's bytes.
struct BaselineJpeg {
    Size size;
    int chroma_shift_x = 0, chroma_shift_y = 0;  // 4:4:4, 4:2:2 or 4:2:0
    std::array<JpegComponent, 3> components;
    int restart_interval = 0;  // units, 0 = none
    ByteView coded;            // from the first coded byte to the end of the input

    Size unit() const { return {8 << chroma_shift_x, 8 << chroma_shift_y}; }
    Size units() const {
        const auto [width, height] = unit();
        return {(size.width + width - 1) / width, (size.height + height - 1) / height};
    }
    Size chroma_size() const {
        return {(size.width + chroma_shift_x) >> chroma_shift_x,
                (size.height + chroma_shift_y) >> chroma_shift_y};
    }
};

// Safe for untrusted input. Unsupported: pictures that read_jpeg_size accepts but our
// decoder leaves to a library: grey and RGB pictures, other subsampling, tables that
// are not in the picture (Motion JPEG), unusual headers.
Result<BaselineJpeg> read_baseline_jpeg(ByteView jpeg);

// Where the next marker in `coded` begins and what it is. Between coded bytes 0xff
// is followed by 0; any number of 0xff may precede a marker's code.
struct JpegMarker {
    std::size_t position = 0;  // of its first 0xff; where coded bytes end if there is none
    std::size_t after = 0;
    std::uint8_t code = 0;  // 0: the input ends first
};
JpegMarker find_jpeg_marker(ByteView coded, std::size_t from);

// True if the picture has an end marker, and no further picture or scan before
// it. `marker` is the marker after its last coded byte.
bool ends_as_jpeg(ByteView coded, JpegMarker marker);

}  // namespace theatron::video
