// SPDX-License-Identifier: Apache-2.0
// What the measured depth of a face tells about the board's pose.
#pragma once

#include "registration/lattice_fit.h"

namespace theatron::registration {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// Axis 0 to 2 of a pose, as the frame it leads to has it.
inline Vec3 axis_of(const Pose& pose, int i) {
    return rotate(pose.rotation, {i == 0 ? 1.0 : 0, i == 1 ? 1.0 : 0, i == 2 ? 1.0 : 0});
}

// What the measured plane says about a pose close to `pose`: information and its product with the
// step towards it.
struct PlaneSays {
    Matrix6 information = Matrix6::Zero();
    Vector6 pull = Vector6::Zero();
};

// `q_covariance` is that of the plane by noise; `trust` how well depth is known beforehand.
PlaneSays plane_says(const Plane& plane, const Matrix3& q_covariance, const Pose& pose,
                     const LatticeTarget& target, const DepthTrust& trust);

}  // namespace theatron::registration
