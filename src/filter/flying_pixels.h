// SPDX-License-Identifier: Apache-2.0
// Removes flying pixels, which a sensor reports between two surfaces: too few of their
// neighbours are at a similar distance.
#pragma once

#include "filter/depth_plane.h"
#include "filter/rules.h"

namespace theatron::filter {

struct FlyingPixelRule {
    Tolerance tolerance;  // a neighbour supports a pixel up to this difference
    int min_support = 3;  // of eight
};

// `in` and `out` are different planes of one size. The reference defines the
// filter; both give equal pixels.
void remove_flying_pixels(const DepthPlane& in, const FlyingPixelRule& rule, DepthPlane& out);
void remove_flying_pixels_reference(const DepthPlane& in, const FlyingPixelRule& rule,
                                    DepthPlane& out);

// The decision for one pixel; `pixel` points into an image with a margin of one.
THEATRON_HD inline std::uint16_t supported_or_none(const std::uint16_t* pixel, std::ptrdiff_t pitch,
                                                   const FlyingPixelRule& rule) {
    const int center = *pixel;
    if (center == none)
        return none;
    // Below the distance itself, so that neighbours without measurement never support.
    const int tolerance = smaller(tolerance_at(rule.tolerance, center), center - 1);
    int support = 0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (dx != 0 || dy != 0)
                support += distance(pixel[dy * pitch + dx], center) <= tolerance;
    return support >= rule.min_support ? std::uint16_t(center) : std::uint16_t(none);
}

}  // namespace theatron::filter
