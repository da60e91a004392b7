// SPDX-License-Identifier: Apache-2.0
// Removes small islands: pixels that hang together, with nothing else at their
// distance around them.
#pragma once

#include <cstdint>
#include <vector>

#include "filter/depth_plane.h"
#include "filter/rules.h"

namespace theatron::filter {

struct SpeckleRule {
    int max_pixels = 24;  // islands of at most so many go
    Tolerance tolerance;  // neighbours, left, right, above, below, this close hang together
};

// What remove_speckles needs while it runs, for planes of one size.
class SpeckleScratch {
public:
    explicit SpeckleScratch(Size size);

    struct Run {  // pixels of a row that hang together
        std::uint16_t begin, end;
        std::uint32_t root;    // the run, itself or an earlier one, that stands for its island
        std::uint32_t pixels;  // of the island, at its root
    };
    std::vector<Run> runs;
    std::vector<std::uint32_t> first_run;  // of each row, and behind the last
    // A bit per pixel of one row: measured; hangs on the pixel left of it, or above.
    std::vector<std::uint64_t> measured, to_left, to_above;
};

// In place. The reference defines the filter.
void remove_speckles(DepthPlane& depth, const SpeckleRule& rule, SpeckleScratch& scratch);
void remove_speckles_reference(DepthPlane& depth, const SpeckleRule& rule);

THEATRON_HD inline bool hang_together(int a, int b, Tolerance tolerance) {
    const int nearer = smaller(a, b);
    return nearer != none && distance(a, b) <= tolerance_at(tolerance, nearer);
}

}  // namespace theatron::filter
