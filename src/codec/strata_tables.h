// SPDX-License-Identifier: Apache-2.0
// Strata's probability tables: one per context, sent as coarse logarithms.
//
// Level 0: the token does not occur. Level n > 0: n = 1 + 2 * log2(frequency), for
// frequencies in units of 1/2048. The levels alone determine the frequencies.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "codec/strata_side.h"
#include "codec/strata_tokens.h"

namespace theatron::codec::strata {

inline constexpr unsigned probability_bits = 11;
inline constexpr unsigned probability_sum = 1u << probability_bits;
inline constexpr unsigned max_level = 2 * probability_bits + 1;

using Levels = std::array<std::array<std::uint8_t, used_tokens>, coded_contexts>;
using Counts = std::array<std::uint32_t, std::size_t(context_count) * token_count>;

// By context and token: frequency | start << 16, where start is the sum of the
// frequencies of the tokens before. 0 for a token that does not occur.
struct Frequencies {
    std::array<std::uint32_t, std::size_t(context_count) * token_count> of;
};

// By context and slot: token | (slot - start) << 8 | frequency << 20.
using SlotTable = std::array<std::uint32_t, std::size_t(context_count) * probability_sum>;

// A slot table kept from frame to frame: only contexts whose levels changed are
// rebuilt.
class Slots {
public:
    const SlotTable& of(const Levels& levels);

private:
    bool made_ = false;
    Levels levels_;
    SlotTable table_;
};

// The levels that intra frames are coded against.
const Levels& standard_levels();

// Selects levels for the counts. A level of `before` is kept where coding its change
// would cost more bits than it saves.
void choose_levels(const Counts& counts, const Levels& before, Levels& levels);

// Writes and reads levels as changes since `before`. Reading returns false if the
// bytes are no such changes.
void put_levels(const Levels& levels, const Levels& before, SideWriter& side);
bool get_levels(const Levels& before, Levels& levels, SideReader& side);

void make_frequencies(const Levels& levels, Frequencies& frequencies);

}  // namespace theatron::codec::strata
