// SPDX-License-Identifier: Apache-2.0
// The places of the set bits in each byte: what a vector instruction that packs lanes to the
// front would give, for instruction sets that have none.
#pragma once

#include <array>
#include <cstdint>

namespace theatron::filter {

struct SetBits {
    std::uint8_t places[8] = {};  // of the set bits, the lowest first; then 0
    std::uint8_t count = 0;
};

// One entry for each value of a byte. Namespace scope: a table inside a function may be copied
// to the stack for each call.
inline constexpr std::array<SetBits, 256> set_bits_of_byte = [] {
    std::array<SetBits, 256> table{};
    for (unsigned byte = 0; byte < table.size(); ++byte)
        for (unsigned bit = 0; bit < 8; ++bit)
            if ((byte >> bit & 1) != 0)
                table[byte].places[table[byte].count++] = std::uint8_t(bit);
    return table;
}();

}  // namespace theatron::filter
