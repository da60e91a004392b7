// SPDX-License-Identifier: Apache-2.0
// Connected regions that are darker than what is around them: among them are frames of strips.
#pragma once

#include <vector>

#include "photon/grey.h"

namespace theatron::photon {

// The least size of a strip's frame, and so of a region.
inline constexpr int least_region_width = 24, least_region_height = 8;

// The convex hulls of regions of at least the least size (either side may be the longer one), at
// most `most` of them, the largest boxes first. Clockwise with y down, corners of pixels.
std::vector<std::vector<Point>> dark_regions(GreyView grey, std::size_t most);

// The quadrilateral around a convex hull that adds the least area: sides of the hull are dropped
// and their neighbours prolonged, until four are left. Nullopt if the hull fills less than
// `least_share` of it, or no proper quad comes out.
std::optional<Quad> quad_around(std::vector<Point> hull, double least_share);

}  // namespace theatron::photon
