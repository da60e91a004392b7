// SPDX-License-Identifier: Apache-2.0
// In which order a participant sees the conditions. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "study/protocol.h"

namespace theatron::study {

// Rows of a Williams design (Williams 1949): each condition stands equally often at each place, and
// equally often directly behind each other one. `count` rows for an even count, twice as many for
// an odd one.
std::vector<std::vector<std::size_t>> williams_design(std::size_t count);

// Indices of the conditions for the participant with this number, from 1. A Latin square gives its
// rows in turn, so that groups of as many participants as it has rows are balanced; which condition
// has which place in the square, and the order of the rows in each group, follow from the seed.
std::vector<std::size_t> condition_order(Order order, std::size_t conditions, std::uint64_t seed,
                                         int participant);

}  // namespace theatron::study
