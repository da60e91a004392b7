// SPDX-License-Identifier: Apache-2.0
// Strata's probability tables: one per context, sent as coarse logarithms.
//
// A level is 0 for a token that does not occur, else 1 + twice the base-2
// logarithm of its frequency in 2048. Frequencies follow from the levels alone.
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

// Per context and token: frequency, and the sum of those before it.
struct Frequencies {
    // frequency | start << 16; for a token that does not occur 0.
    std::array<std::uint32_t, std::size_t(context_count) * token_count> of;
};

// For each slot of each context: token | (slot - start) << 8 | frequency << 20.
using SlotTable = std::array<std::uint32_t, std::size_t(context_count) * probability_sum>;

// A slot table that is kept from frame to frame: most contexts keep their levels.
class Slots {
public:
    const SlotTable& of(const Levels& levels);

private:
    bool made_ = false;
    Levels levels_;
    SlotTable table_;
};

// What intra frames start from.
const Levels& standard_levels();

// The levels that suit the counts. Contexts and tokens whose change would cost
// more than it gains keep those of `before`.
void choose_levels(const Counts& counts, const Levels& before, Levels& levels);

// Writes and reads levels as changes since `before`.
void put_levels(const Levels& levels, const Levels& before, SideWriter& side);
bool get_levels(const Levels& before, Levels& levels, SideReader& side);

void make_frequencies(const Levels& levels, Frequencies& frequencies);

}  // namespace theatron::codec::strata
