// SPDX-License-Identifier: Apache-2.0
// The rigid motion between two sets of points.
#pragma once

#include <span>

#include "geometry/vec.h"

namespace theatron::registration {

struct RigidFit {
    Pose pose;         // to the second set from the first
    double rms_m = 0;  // of the distances that remain
};

// Least squares after Umeyama (PAMI 1991), without scale. `from` and `to` have the same length, one
// or more; points that all lie on one line leave the rotation about it open.
RigidFit fit_rigid(std::span<const Vec3> from, std::span<const Vec3> to);

}  // namespace theatron::registration
