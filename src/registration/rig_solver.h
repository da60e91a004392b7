// SPDX-License-Identifier: Apache-2.0
// The relative poses of cameras, from all their views of the board at once.
//
// Every camera pose, every board pose and each camera's depth errors are unknown: one robust
// least-squares problem weighs the edges and the depth of each view by their own uncertainty. The
// edges do not depend on depth, so together with the board's known size they determine a camera's
// depth error, and its change over the image and with distance. Cameras that never see the board
// together are joined through others. Either face of the board may be seen.
#pragma once

#include <vector>

#include "registration/lattice_detector.h"

namespace theatron::registration {

// One camera's view of the board in one of its places.
struct BoardView {
    int camera = 0, place = 0;  // counted from 0
    Detection detection;
};

// A camera measures too far by
//     offset_m + per_x * x + per_y * y + per_m * (z - reference_m)
// along its axis, where (x, y, 1) is the direction and z the depth, metres.
struct DepthBias {
    static constexpr double reference_m = 2;

    double offset_m = 0, per_x_m = 0, per_y_m = 0, per_m = 0;

    template <class T>
    static T at(const T* bias, const T& x, const T& y, const T& z) {
        return bias[0] + bias[1] * x + bias[2] * y + bias[3] * (z - reference_m);
    }
};

struct CameraPlace {
    Pose reference_from_camera;  // camera 0 is the reference
    // Covariance of rotation (about the camera's axes, radians) and translation (along them,
    // metres); zero for camera 0.
    Matrix6 covariance = Matrix6::Zero();
    DepthBias bias, bias_sigma;
};

struct RigSolution {
    std::vector<CameraPlace> cameras;
    std::vector<Pose> reference_from_board;  // by place
    // Cameras without a chain of shared places to camera 0.
    // If there are any, nothing is solved.
    std::vector<int> separate;
    bool converged = false;
    // Root mean square of weighted residuals: about 1 where the stated uncertainties are true.
    double residual = 0;
    // For each view the root mean square of the distances between the board's outer corners
    // according to this view and according to the solution, metres.
    std::vector<double> view_error_m;
};

// Standard deviations of the priors, at most; the defaults fit an Azure Kinect. The solver takes
// smaller ones where depth and edges of all views agree better (type II maximum likelihood).
struct RigOptions {
    double offset_m = 0.003;
    double slope_m = 0.003;  // of per_x_m and per_y_m
    double per_m = 0.001;
    // Depth errors of one view that DepthBias does not describe: shared by the face, and at places
    // of it independently.
    double view_common_m = 0.001, view_slow_m = 0.001;
    double outlier_sigmas = 3;  // views further off count less
};

// Root mean square distance of the board's outer corners in two poses, metres.
double corner_distance_m(const LatticeTarget& target, const Pose& a, const Pose& b);

// `cameras` (at least one) and `places` are the numbers of cameras and places in `views`.
RigSolution solve_rig(int cameras, int places, const std::vector<BoardView>& views,
                      const LatticeTarget& target, const RigOptions& options = {});

}  // namespace theatron::registration
