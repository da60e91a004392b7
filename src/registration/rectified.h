// SPDX-License-Identifier: Apache-2.0
// A plane of a depth image seen from in front, as a picture of small cells.
#pragma once

#include <cstdint>
#include <vector>

#include "registration/pixel_lookup.h"
#include "registration/plane_search.h"

namespace theatron::registration {

// Looks up the depth image's measurement at the projection of a point.
struct DepthLookup {
    DepthView depth;
    const CameraModel* camera = nullptr;
    const PixelLookup* pixels = nullptr;  // of this camera
    double metres_per_unit = 0.001;
};

// Axes on the plane, unit vectors in the camera's frame; z points to the camera.
struct PlaneAxes {
    Vec3 origin, x, y, z;
};

PlaneAxes axes_on(const Plane& plane, Vec3 middle);
PlaneAxes turned(const PlaneAxes& axes, double angle);

// +1 on the surface, -1 where the camera measures a point behind the plane,
// 0 where it is unknown.
struct Rectified {
    int side = 0;  // cells in a row and in a column
    std::vector<std::int8_t> value;

    const std::int8_t* row(int y) const { return &value[std::size_t(y) * std::size_t(side)]; }
};

// Cells of `cell_m`, up to `reach_m` from the origin of `axes` along both axes.
Rectified rectify(const DepthLookup& lookup, const PlaneAxes& axes, double reach_m, double cell_m);

// The same picture for axes that are turned by a quarter, counter-clockwise.
Rectified quarter_turned(const Rectified& picture);

// The direction of the picture's edges, within an eighth of a turn of the x axis, radians. `arm`:
// half of the window, in cells; nothing is known along edges for some centimetres.
double edge_angle(const Rectified& picture, int arm);

}  // namespace theatron::registration
