// SPDX-License-Identifier: Apache-2.0
// Strata's value table, for sensors that output few distinct depths.
//
// Stereo and structured-light sensors measure disparities, so that their depths lie
// on a coarse grid. A depth is then coded as its rank among the depths in use:
// neighbouring grid values differ by 1.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/strata_kernel.h"
#include "codec/strata_side.h"
#include "image/view.h"

namespace theatron::codec::strata {

inline constexpr std::size_t max_values = 4096;
// The rank of the smallest value. Predictions may be below it.
inline constexpr std::uint16_t first_rank = 256;

using Values = std::vector<std::uint16_t>;  // ascending, neither 0 nor 65535

// The distinct values of an image, or none if coding ranks would save fewer bits
// than the tolerance does.
Values find_values(DepthView depth, Tolerance tolerance);

// Writes and reads the values of `values` that `before` lacks. Reading returns false
// if the bytes are malformed or the list would exceed max_values.
void put_values(const Values& before, const Values& values, SideWriter& side);
bool get_values(const Values& before, Values& values, SideReader& side);

// Converts ranks in `before` to ranks in `values`, a superset of `before`.
class RankShift {
public:
    RankShift(const Values& before, const Values& values);
    // `to` may be `from`.
    void apply(const std::uint16_t* from, std::size_t count, std::uint16_t* to) const;

private:
    std::vector<std::uint16_t> bounds_;
    std::vector<std::uint16_t> table_;  // from any rank to its new rank, if there are many bounds
};

// Look-up tables between depths and ranks, rebuilt only when the values change.
class RankTables {
public:
    // Writes an image as ranks in step order, and adds its new values to `values`.
    // 0 and 65535 are kept. False if there are more than max_values values; `values`
    // and `pixels` are then unspecified.
    bool to_ranks(const Layout& layout, DepthView depth, Values& values, std::uint16_t* pixels);
    // The depth of each of the 65536 ranks, 0 for ranks without a value. Valid until
    // the next call.
    const std::uint16_t* depths_of(const Values& values);

private:
    void use(const Values& values);

    Values forward_values_, backward_values_;
    std::vector<std::uint16_t> forward_, backward_;
    NewDepths new_;
};

}  // namespace theatron::codec::strata
