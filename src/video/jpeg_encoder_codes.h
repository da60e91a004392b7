// SPDX-License-Identifier: Apache-2.0
// The standard Huffman codes in tables for our JPEG encoder: each code is already
// followed by the bits of its value.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "video/jpeg_encoder_tables.h"

namespace theatron::video::jpeg {

// Bits to write and, in the lowest six, how many: a Huffman code and the bits of
// a value after it are at most 26.
using Code = std::uint32_t;

// The codes of luma or of chroma. Rows are for the distance, in zigzag order, from
// the last coefficient that was coded; row 0 is for DC.
struct CodeTables {
    // Codes of values from -small to small - 1: nearly all values.
    static constexpr int small = 128;
    Code by_value[17][2 * small];
    // Codes of the others by their size; the bits of the value are zero.
    Code by_size[17][12];
    Code end_of_block, sixteen_zeros;
};

// Number of bits of a value's magnitude. Doubled, so that 0 is no special case.
constexpr int size_of(int value) {
    return std::bit_width(2 * unsigned(value < 0 ? -value : value) + 1) - 1;
}

constexpr Code code_of(const HuffmanCodes& codes, int symbol, int size) {
    return Code(codes.bits[symbol]) << (size + 6) | Code(codes.length[symbol] + size);
}

// Negative values are written less 1, in as many bits as their magnitude has.
constexpr Code with_value(Code code, int value, int size) {
    return code | (unsigned(value + (value >> 31)) & ((1u << size) - 1)) << 6;
}

constexpr CodeTables make_codes(int kind) {
    const HuffmanCodes dc = codes_of(dc_tables[kind]), ac = codes_of(ac_tables[kind]);
    CodeTables tables{};
    for (int distance = 0; distance <= 16; ++distance) {
        Code* const by_size = tables.by_size[distance];
        for (int size = 0; size < 12; ++size)
            by_size[size] = distance == 0 ? code_of(dc, size, size)
                                          : code_of(ac, (distance - 1) << 4 | size, size);
        for (int value = -CodeTables::small; value < CodeTables::small; ++value)
            tables.by_value[distance][value + CodeTables::small] =
                with_value(by_size[size_of(value)], value, size_of(value));
    }
    tables.end_of_block = code_of(ac, end_of_block, 0);
    tables.sixteen_zeros = code_of(ac, sixteen_zeros, 0);
    return tables;
}

inline constexpr CodeTables codes[2] = {make_codes(0), make_codes(1)};

}  // namespace theatron::video::jpeg
