// SPDX-License-Identifier: Apache-2.0
// The part of a picture that our JPEG encoder works on at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "video/jpeg_zigzag.h"

namespace theatron::video::jpeg {

// A picture is encoded in tiles of this width and one unit's height, which stay
// in the innermost cache from pixels to bits.
inline constexpr int tile_width = 64;
inline constexpr int tile_blocks = tile_width / 8;

// A row of blocks: samples, then in the same place coefficients. Those of a block
// lie column by column, each column tile_width after the one before.
struct BlockRow {
    alignas(64) std::int16_t values[8][tile_width];
    // Bit mask of a block's nonzero coefficients: a byte per column, the lowest bit on top.
    std::uint8_t nonzero[8][tile_blocks];
};

// Where the k-th coefficient of a block lies.
inline constexpr auto place_of = [] {
    std::array<std::uint16_t, 64> place{};
    for (std::size_t k = 0; k < 64; ++k)
        place[k] = std::uint16_t(jpeg_zigzag[k] % 8 * tile_width + jpeg_zigzag[k] / 8);
    return place;
}();

// The bytes of BlockRow::nonzero as sets of k.
inline constexpr auto in_zigzag = [] {
    std::array<std::array<std::uint64_t, 256>, 8> sets{};
    for (std::size_t k = 0; k < 64; ++k)
        for (unsigned byte = 0; byte < 256; ++byte)
            if (byte >> (jpeg_zigzag[k] / 8) & 1)
                sets[jpeg_zigzag[k] % 8][byte] |= std::uint64_t(1) << k;
    return sets;
}();

}  // namespace theatron::video::jpeg
