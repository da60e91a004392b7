// SPDX-License-Identifier: Apache-2.0
// Strata's value table: for sensors that use few of all depths.
//
// Stereo and structured-light sensors measure disparities; their depths lie on a
// coarse grid. Such depths are coded as their rank among those in use, which makes
// neighbours on a surface neighbours in number.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/strata_kernel.h"
#include "codec/strata_side.h"
#include "image/view.h"

namespace theatron::codec::strata {

inline constexpr std::size_t max_values = 4096;
// The rank of the smallest value; predictions may be a little smaller.
inline constexpr std::uint16_t first_rank = 256;

using Values = std::vector<std::uint16_t>;  // ascending, neither 0 nor 65535

// The values of an image, if it pays to code their ranks rather than to make use
// of the tolerance; else none.
Values find_values(DepthView depth, Tolerance tolerance);

// Adds those that the image has and `values` has not. False if there are too
// many; `values` is then unspecified.
bool add_values(DepthView depth, Values& values);

// Writes and reads the values that `values` has in addition to `before`.
void put_values(const Values& before, const Values& values, SideWriter& side);
bool get_values(const Values& before, Values& values, SideReader& side);

// To ranks and back, with tables that are kept while the values stay the same.
class RankTables {
public:
    // 0 and 65535 stay what they are. False if the image has other values than
    // those given; `ranks` is then unspecified.
    bool to_ranks(DepthView depth, const Values& values, MutableDepthView ranks);
    // Ranks without a value become 0.
    void from_ranks(const Values& values, MutableDepthView depth);

private:
    Values forward_values_, backward_values_;
    std::vector<std::uint16_t> forward_, backward_;
};

// Ranks in `before` as ranks in `values`, which has all of `before`.
void move_ranks(const Values& before, const Values& values, const std::uint16_t* from,
                std::size_t count, std::uint16_t* to);

}  // namespace theatron::codec::strata
