// SPDX-License-Identifier: Apache-2.0
// The small rigid motion that brings points onto planes, where some of the points belong to
// something else.
#pragma once

#include <vector>

#include "registration/lattice_fit.h"

namespace theatron::registration {

// A point, and the unit normal of the plane that it should lie on; one frame for all, metres.
struct PointOnPlane {
    Vec3 at, normal;
    double apart_m = 0;  // from the plane to the point, along the normal
};

struct SmallMotion {
    Pose motion;  // moves the points onto the planes
    // Root mean square of the lengths by which it moves the points that count, metres.
    double size_m = 0;
    // The shares of points within the tolerance of their planes, before and after.
    double share_before = 0, share = 0;
    std::size_t points = 0;
    // Covariance of `motion` as in LatticeFit, for independent errors of the points.
    Matrix6 covariance = Matrix6::Zero();
    double rms_m = 0;  // of the points that count, after
};

// Iterated least squares with Tukey's weights (Beaton and Tukey, Technometrics 1974): points
// further than `tolerance_m` from their plane do not count in the end. Directions that the planes
// do not determine stay as they are. Motions up to some centimetres and one degree are found.
SmallMotion fit_small_motion(const std::vector<PointOnPlane>& points, double tolerance_m);

}  // namespace theatron::registration
