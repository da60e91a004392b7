// SPDX-License-Identifier: Apache-2.0
// The part of a picture that our JPEG encoder works on at a time.
#pragma once

#include <cstdint>

namespace theatron::video::jpeg {

// A picture is encoded in tiles of this width and one unit's height, which stay
// in the innermost cache from pixels to bits.
constexpr int tile_width = 64;
constexpr int tile_blocks = tile_width / 8;

// A row of blocks: samples, then in the same place coefficients. Those of a block
// lie column by column, each column tile_width after the one before.
struct BlockRow {
    alignas(64) std::int16_t values[8][tile_width];
    // Which of a block's coefficients are not 0: a byte per column, lowest bit on top.
    std::uint8_t nonzero[8][tile_blocks];
};

}  // namespace theatron::video::jpeg
