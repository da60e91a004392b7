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

// Writes and reads the values that `values` has in addition to `before`.
void put_values(const Values& before, const Values& values, SideWriter& side);
bool get_values(const Values& before, Values& values, SideReader& side);

// Turns ranks in `before` into ranks in `values`, which has all of `before`.
class RankShift {
public:
    RankShift(const Values& before, const Values& values);
    // `to` may be `from`.
    void apply(const std::uint16_t* from, std::size_t count, std::uint16_t* to) const;

private:
    std::vector<std::uint16_t> bounds_;
    std::vector<std::uint16_t> table_;  // of all ranks, if there are many bounds
};

// The tables for both ways, kept while the values stay the same.
class RankTables {
public:
    // Writes an image as ranks by step and lane. Adds the values that it has and
    // `values` has not. 0 and 65535 stay what they are. False if there are too many
    // values; `values` and `pixels` are then unspecified.
    bool to_ranks(const Layout& layout, DepthView depth, Values& values, std::uint16_t* pixels);
    // The depth of each of 65536 ranks, 0 for those without a value.
    const std::uint16_t* depths_of(const Values& values);

private:
    void use(const Values& values);

    Values forward_values_, backward_values_;
    std::vector<std::uint16_t> forward_, backward_;
    NewDepths new_;
};

}  // namespace theatron::codec::strata
