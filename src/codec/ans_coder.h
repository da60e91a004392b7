// SPDX-License-Identifier: Apache-2.0
// Entropy coding of number sequences with an asymmetric numeral system (rANS).
//
// J. Duda, "Asymmetric numeral systems", 2013. A number becomes a symbol, coded with
// a frequency table that precedes the symbols, and extra bits, stored uncompressed.
// The sequence is split into four parts of equal length, coded by four coders in
// turn, so that their latencies overlap. The table of a symbol depends on the symbols
// before it in its part (the Model). docs/formats/depth_ans.md specifies the bytes.
#pragma once

#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "base/bytes.h"
#include "base/status.h"

namespace theatron::codec::ans {

inline constexpr int scale_bits = 11;
inline constexpr std::uint32_t scale = 1u << scale_bits;
inline constexpr int lanes = 4;

// Maps numbers to symbols. Numbers below `direct` have a symbol each. Larger numbers
// of the same quarter octave share one; extra bits distinguish them.
template <std::uint32_t direct, int max_bits>
struct Alphabet {
    static_assert(direct % 4 == 0 && std::bit_width(direct) >= 3);
    // direct is 4/4, 5/4, 6/4 or 7/4 of a power of two.
    static constexpr int first_octave = int(std::bit_width(direct)) - 1;
    static constexpr std::uint32_t first_quarter =
        std::uint32_t(first_octave) * 4 + ((direct >> (first_octave - 2)) & 3);
    static constexpr std::uint32_t size = direct + std::uint32_t(max_bits) * 4 - first_quarter;
    static_assert(size <= 256);

    static std::uint32_t symbol(std::uint32_t number) {
        if (number < direct)
            return number;
        const auto octave = std::uint32_t(std::bit_width(number)) - 1;
        const std::uint32_t quarter = (number >> (octave - 2)) & 3;
        return direct + octave * 4 + quarter - first_quarter;
    }
    static std::uint32_t extra_bits(std::uint32_t symbol) {
        return symbol < direct ? 0 : (symbol - direct + first_quarter) / 4 - 2;
    }
    // The smallest number of a symbol.
    static std::uint32_t base(std::uint32_t symbol) {
        if (symbol < direct)
            return symbol;
        const std::uint32_t at = symbol - direct + first_quarter;
        return (4 + at % 4) << (at / 4 - 2);
    }
};

// Run lengths; the two kinds alternate.
struct RunModel {
    using Symbols = Alphabet<16, 27>;
    static constexpr int contexts = 2;
    static std::uint32_t start(std::size_t index) { return std::uint32_t(index & 1); }
    static std::uint32_t context(std::uint32_t state) { return state; }
    static std::uint32_t next(std::uint32_t state, std::uint32_t) { return state ^ 1; }
};

// Zigzagged differences. Large differences tend to follow large ones, so a running
// mean of the symbols selects the table.
struct DifferenceModel {
    using Symbols = Alphabet<192, 16>;
    static constexpr int contexts = 6;
    static constexpr auto context_of_mean = [] {
        std::array<std::uint8_t, 512> table{};
        for (int mean = 0; mean < 512; ++mean)
            table[std::size_t(mean)] =
                std::uint8_t((mean > 3) + (mean > 7) + (mean > 14) + (mean > 28) + (mean > 80));
        return table;
    }();
    static std::uint32_t start(std::size_t) { return 0; }
    static std::uint32_t context(std::uint32_t twice_mean) { return context_of_mean[twice_mean]; }
    static std::uint32_t next(std::uint32_t twice_mean, std::uint32_t symbol) {
        return (twice_mean + 2 * symbol + 1) / 2;
    }
};

// Buffers of one coder, reused from frame to frame.
struct Workspace {
    // Symbols with their contexts; coded from the last to the first.
    std::vector<std::uint16_t> symbols;
    std::vector<std::uint16_t> words;
    Bytes extra;
    std::vector<std::uint32_t> decode_tables;
};

// Bytes that always suffice for `count` numbers.
std::size_t max_encoded_numbers(std::size_t count);

// Encodes `numbers` into `out` and returns the bytes used.
std::size_t encode_runs(std::span<const std::uint32_t> numbers, Workspace& work,
                        std::span<std::byte> out);
std::size_t encode_differences(std::span<const std::uint32_t> numbers, Workspace& work,
                               std::span<std::byte> out);

// Decodes exactly numbers.size() numbers and removes their bytes from the front of
// `in`. Safe for untrusted input.
Status decode_runs(ByteView& in, Workspace& work, std::span<std::uint32_t> numbers);
Status decode_differences(ByteView& in, Workspace& work, std::span<std::uint32_t> numbers);

}  // namespace theatron::codec::ans
