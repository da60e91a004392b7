// SPDX-License-Identifier: Apache-2.0
// Coloured points, and PLY files of them.
#pragma once

#include <span>
#include <string>
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

// Appends a point in the depth camera's frame for each measured pixel of `depth`. `rays` is
// the ray table of calibration.depth. A point gets the colour of the nearest pixel that it
// is projected to, else unseen_color. `color` may be empty.
void append_points(DepthView depth, const Image<Ray>& rays, ColorView color,
                   const Calibration& calibration, std::vector<ColoredPoint>& out);

// Transforms the points in place.
void transform_points(const Pose& a_from_b, std::span<ColoredPoint> points);

// Comments of a PLY file: the frame of its points.
inline constexpr const char* points_in_camera =
    "x right, y down, z forward in metres, from the depth camera";
inline constexpr const char* points_in_room =
    "x, y, z in metres in the room: y up, 0 on the floor, right-handed";

// A complete binary little-endian PLY file: x, y, z as float, red, green, blue as uchar. Each
// comment is one line without a line break; empty ones are left out.
Bytes encode_ply(std::span<const ColoredPoint> points, std::span<const std::string> comments = {});

}  // namespace theatron
