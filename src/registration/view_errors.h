// SPDX-License-Identifier: Apache-2.0
// The errors of one view of the board, with their derivatives by the unknowns that they depend on.
#pragma once

#include <Eigen/Dense>
#include <array>

#include "registration/rig_solver.h"

namespace theatron::registration {

// Unknowns of one view: a small turn and shift of the camera, then of the board, then the camera's
// depth errors (as DepthBias has them). A turn is half the angle about the reference's axes, as the
// vector part of a quaternion.
constexpr int pose_unknowns = 6, bias_unknowns = 4;
constexpr int view_unknowns = 2 * pose_unknowns + bias_unknowns;

using Bias = Eigen::Matrix<double, bias_unknowns, 1>;

// `pose` after a small turn and shift.
Pose moved(const Pose& pose, const Eigen::Matrix<double, pose_unknowns, 1>& step);

// Weighed by their uncertainty: without errors of other kinds each value has variance 1.
template <int n>
struct Residual {
    Eigen::Matrix<double, n, 1> value;
    Eigen::Matrix<double, n, view_unknowns> derivatives;
};

// The measurements of one view: a pose by the edges of the board, and the depth of its face.
class ViewErrors {
public:
    ViewErrors(const BoardView& view, const LatticeTarget& target, const RigOptions& options);

    struct Both {
        Residual<6> edges;  // turn, shift
        Residual<3> depth;  // at three places of the face
    };
    Both at(const Pose& reference_from_camera, const Pose& reference_from_board,
            const Bias& bias) const;

    // Logarithm of the root of the determinant of the depth's information.
    double log_root_of_depth() const;

private:
    Pose face_from_camera_;  // by the edges
    Pose board_from_face_;
    Matrix6 edge_root_;           // its transpose times itself is the inverse of the covariance
    Plane plane_;                 // of the face, by depth
    std::array<Vec3, 3> places_;  // in the board's frame
    Matrix3 depth_root_;
};

}  // namespace theatron::registration
