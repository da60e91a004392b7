// SPDX-License-Identifier: Apache-2.0
// Polygons as triangles.
#pragma once

#include <span>
#include <vector>

#include "medical/mesh.h"

namespace theatron::cases {

inline constexpr std::size_t max_polygon_corners = 2000;

// Appends the triangles of a polygon, also of one that is not convex, with its direction kept:
// corners - 2 of them. `corners` are valid numbers of `positions`.
void add_polygon(std::span<const std::uint32_t> corners,
                 const std::vector<medical::Vec3f>& positions,
                 std::vector<medical::Triangle>& triangles);

}  // namespace theatron::cases
