// SPDX-License-Identifier: Apache-2.0
// Removes speckles: small connected components of pixels at similar distances.
#pragma once

#include <cstdint>
#include <vector>

#include "filter/depth_plane.h"
#include "filter/rules.h"

namespace theatron::filter {

struct SpeckleRule {
    int max_pixels = 24;  // size of the largest component that is removed
    Tolerance tolerance;  // direct neighbours that differ by at most this are linked
};

// Working memory of remove_speckles, for planes of one size.
class SpeckleScratch {
public:
    explicit SpeckleScratch(Size size);

    struct Run {  // linked pixels of one row
        std::uint16_t begin, end;
        std::uint32_t root;    // a run of the component, itself or an earlier one
        std::uint32_t pixels;  // of the component; valid at its root
    };
    std::vector<Run> runs;
    std::vector<std::uint32_t> first_run;  // of each row, and one entry for the end
    // One bit per pixel of a row: measured; linked to the pixel at the left; to the one above.
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
