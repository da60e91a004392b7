// SPDX-License-Identifier: Apache-2.0
// The evidence of a face's measured depth about the board's pose.
#pragma once

#include "registration/lattice_fit.h"

namespace theatron::registration {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// Axis 0 to 2 of a pose, in the frame that it transforms into.
inline Vec3 axis_of(const Pose& pose, int i) {
    return rotate(pose.rotation, {i == 0 ? 1.0 : 0, i == 1 ? 1.0 : 0, i == 2 ? 1.0 : 0});
}

// Normal equations of the measured plane for a pose close to `pose` (turn, then shift): the
// information, and its product with the step.
struct PlaneSays {
    Matrix6 information = Matrix6::Zero();
    Vector6 pull = Vector6::Zero();
};

// `q_covariance`: the plane's covariance by noise. `trust`: deviations of the depth errors.
PlaneSays plane_says(const Plane& plane, const Matrix3& q_covariance, const Pose& pose,
                     const LatticeTarget& target, const DepthTrust& trust);

}  // namespace theatron::registration
