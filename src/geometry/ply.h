// SPDX-License-Identifier: Apache-2.0
// Coloured points, and the PLY files that hold them.
#pragma once

#include <span>
#include <vector>

#include "base/bytes.h"
#include "geometry/calibration.h"
#include "geometry/ray_table.h"
#include "image/view.h"

namespace theatron {

struct ColoredPoint {
    float x = 0, y = 0, z = 0;  // metres
    Rgb color;
    bool operator==(const ColoredPoint&) const = default;
};

// The colour of points that the colour camera does not see.
inline constexpr Rgb unseen_color{128, 128, 128};

// Appends a point in the depth camera's frame for each reading of `depth`.
// `rays` is calibration.depth's table. `color` may be empty; each point has the
// colour of the nearest pixel where it is imaged.
void append_points(DepthView depth, const Image<Ray>& rays, ColorView color,
                   const Calibration& calibration, std::vector<ColoredPoint>& out);

// The points moved by `a_from_b`, from `first` on.
void transform_points(const Pose& a_from_b, std::span<ColoredPoint> points);

// A whole binary little-endian PLY file: x, y, z as float, red, green, blue as uchar.
Bytes encode_ply(std::span<const ColoredPoint> points);

}  // namespace theatron
