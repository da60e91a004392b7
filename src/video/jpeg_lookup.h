// SPDX-License-Identifier: Apache-2.0
// Huffman codes as look-up tables of the fast decoder: one look-up of the next bits gives
// up to two symbols, their values, and whether the block ends.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "video/jpeg_baseline.h"

namespace theatron::video {

class JpegLookup {
public:
    // Bits. One more decides more, but the four tables of a picture then fill two first-level
    // caches of 32 KB.
    static constexpr int look = 10;
    static constexpr std::uint8_t undecided = 64;

    struct Entry {
        std::uint8_t bits;    // that it takes
        std::uint8_t first;   // how far the first coefficient is from the one before
        std::uint8_t second;  // and the second; the same as `first` if there is none
        std::int8_t ends;     // -1: the block does, else 0. An end alone puts a 0 one further.
        std::int16_t first_value, second_value;
    };
    // If one look-up has too few bits, `second` is `undecided`. Then `bits` are those
    // of the first code, and `first` its symbol, or `bits` are 0 if it has more.

    // Sets the codes of one of three components. Does nothing if they are as before.
    void set(std::size_t component, const JpegHuffmanCode& dc, const JpegHuffmanCode& ac);

    // For the first bits of a block, whose first value is DC's, and for those after.
    const Entry* start(std::size_t component) const { return &entries_[start_at(component)]; }
    const Entry* inside(std::size_t component) const { return &entries_[inside_at(component)]; }

private:
    static constexpr std::size_t start_at(std::size_t component) { return 2 * component << look; }
    static constexpr std::size_t inside_at(std::size_t component) {
        return (2 * component + 1) << look;
    }

    using Key = std::array<std::byte, 2 * 16 + 2 * 256>;
    std::array<std::optional<Key>, 3> keys_;  // of the tables in entries_
    std::array<Entry, 6 << look> entries_{};
};

// The symbol at the front of 16 bits, the slow way.
struct JpegSymbol {
    int bits = 0;  // of its code; 0: there is no such code
    int value = 0;
};
JpegSymbol find_jpeg_symbol(const JpegHuffmanCode& code, unsigned bits);

}  // namespace theatron::video
