// SPDX-License-Identifier: Apache-2.0
// Fits the lattice to the pixels of one depth image.
//
// The pose follows from two measurements with different errors. For each pixel near an edge, the
// share that the board covers is compared with the share that the pixel shows, so that edges are
// found to small fractions of a pixel; this needs no accurate depth. The depth of the face is a
// plane from thousands of pixels: it has little noise, but the camera's fixed errors. Both are
// returned separately, so that a solver over several cameras and poses can find those errors.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "registration/lattice_edges.h"
#include "registration/lattice_match.h"

namespace theatron::registration {

using Matrix3 = Eigen::Matrix3d;
// Covariance of a pose: rotation about its axes (radians), then translation along them (metres).
using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct LatticeFit {
    // From edges and depth together, for a camera whose depth errors are typical and unknown.
    Pose camera_from_face;
    Matrix6 covariance = Matrix6::Identity();

    Pose camera_from_face_by_edges;
    Matrix6 edge_covariance = Matrix6::Identity();
    Plane plane;                                     // of the face, as depth was measured
    Matrix3 plane_covariance = Matrix3::Identity();  // of Plane::q, noise alone

    EdgeParams edges;
    double plane_rms_m = 0;  // of measurements on the face from its plane
    double edge_rms = 0;     // of covered shares of pixels at the edges, 0 to 1
    int plane_pixels = 0, edge_pixels = 0;
};

// Standard deviations of depth errors beforehand, metres.
struct DepthTrust {
    double common_m = 0.004;  // deviation of the error that a whole face shares
    double slow_m = 0.0015;   // of the error that changes slowly over the image
};

// The places on a face whose measured depths determine its plane. Their errors that change slowly
// over the image are treated as independent.
std::array<Vec3, 3> depth_places(const LatticeTarget& target);

// `measure` also compares the image with one that is computed for the pose, pixel by pixel, so that
// neither the pixels' grid nor the model of edges shifts the result. It takes about 20 ms more, and
// pays for means of many frames.
enum class FitEffort : std::uint8_t { find, measure };

// `rays` has a ray for each pixel of `depth`. Empty if the fit moves too far from `match`, or if
// too few pixels remain.
std::optional<LatticeFit> fit_lattice(const DepthLookup& depth, const Image<Ray>& rays,
                                      const LatticeMatch& match, const LatticeTarget& target,
                                      FitEffort effort, const DepthTrust& trust = {});

}  // namespace theatron::registration
