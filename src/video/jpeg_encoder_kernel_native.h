// SPDX-License-Identifier: Apache-2.0
// The inner part of our JPEG encoder: from pixels to the bytes of a scan, with
// the best instructions of this CPU. jpeg_encoder_reference.h defines it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "image/view.h"
#include "video/jpeg_encoder_rule.h"

namespace theatron::video::jpeg {

// Bits to write and, in the lowest six, how many: a Huffman code and the bits of
// a value after it are at most 26.
using Code = std::uint32_t;

// The codes of luma or of chroma. Rows are for the distance, in zigzag order, from
// the last coefficient that was coded; row 0 is for DC.
struct CodeTables {
    // Of small values, which nearly all are.
    static constexpr int small = 128;
    Code by_value[17][2 * small];
    // Of others by their size; the value's bits are still zero.
    Code by_size[17][12];
    Code end_of_block, sixteen_zeros;
};

// Per component kind, luma and chroma, and place of a coefficient in a
// transformed block, which is stored column by column.
struct ScanTables {
    alignas(64) std::int16_t factor[2][64];
    alignas(64) std::int16_t scale[2][64];

    explicit ScanTables(int quality);
};

// An upper bound of what a scan takes, and of its part of one row of units
// before stuffing. A coefficient takes at most 26 bits, and stuffing at most
// doubles them. Hardly any of it is ever touched.
std::size_t max_scan_size(Size size, bool halve_chroma);
std::size_t max_row_size(int width, bool halve_chroma);

// Writes the scan of `image` to `out`, which holds max_scan_size, and returns
// its end. `row_buffer` holds max_row_size.
std::uint8_t* encode_scan(ColorView image, bool halve_chroma, const ScanTables& tables,
                          std::uint8_t* row_buffer, std::uint8_t* out);

}  // namespace theatron::video::jpeg
