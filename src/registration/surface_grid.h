// SPDX-License-Identifier: Apache-2.0
// The smooth surfaces in a depth image, as points with normals on a coarse grid of its pixels, and
// how far apart two cameras see the same surface.
#pragma once

#include <optional>
#include <vector>

#include "geometry/ray_table.h"
#include "registration/rig_solver.h"

namespace theatron::registration {

struct SurfacePoint {
    Vec3 at;      // camera frame, metres
    Vec3 normal;  // unit, towards the camera; zero: no smooth surface was measured here
    bool is_valid() const { return normal.z != 0; }
};

// A depth camera with its ray table, so that both are computed once.
struct SurfaceCamera {
    CameraModel model;
    double depth_unit_mm = 1;
    Image<Ray> rays;
    DepthBias bias;  // taken from what it measures

    SurfaceCamera(const CameraModel& camera, double unit_mm)
        : model(camera), depth_unit_mm(unit_mm), rays(make_ray_table(camera)) {}
};

// Pixels from one point of the grid to the next.
inline constexpr int surface_step = 8;
Size surface_grid_size(Size image);

// The surface around a pixel: the mean of nine measurements a few pixels apart, which must be
// there, lie on one plane, and be seen at less than 70 degrees.
std::optional<SurfacePoint> surface_at(const SurfaceCamera& camera, DepthView depth, int x, int y);

// Row by row; surface_grid_size() of them.
std::vector<SurfacePoint> surface_grid(const SurfaceCamera& camera, DepthView depth);

// A place where two cameras see one surface.
struct OverlapPoint {
    Vec3 at, normal;     // a's point and b's normal, in the frame of camera b
    double apart_m = 0;  // from b's plane to a's point along the normal
    int cell = 0;        // of a's grid
};

// Points of camera a on surfaces of camera b, at most `farthest_m` apart. `b_from_a` is the poses'
// opinion.
std::vector<OverlapPoint> overlap(const std::vector<SurfacePoint>& a, const SurfaceCamera& b,
                                  DepthView b_depth, const Pose& b_from_a, double farthest_m);

// The median of |apart_m|, metres; 0 without points.
double median_apart_m(const std::vector<OverlapPoint>& points);

}  // namespace theatron::registration
