// SPDX-License-Identifier: Apache-2.0
// Views of the board as a camera without errors has them.
#pragma once

#include "registration/rig_solver.h"

namespace theatron::registration {

// `measured_longer_m` is how much too far the camera measures everywhere on the face, along its
// axis. The edges do not depend on it.
inline BoardView exact_view(int camera, int place, const Pose& camera_from_board,
                            const LatticeTarget& target, Face face = Face::front,
                            double measured_longer_m = 0) {
    const Pose pose = camera_from_board * board_from_face(target, face);
    BoardView view{camera, place, {}};
    view.detection.camera_from_board = camera_from_board;
    view.detection.match.face = face;
    view.detection.match.camera_from_face = pose;
    LatticeFit& fit = view.detection.fit;
    fit.camera_from_face = fit.camera_from_face_by_edges = pose;
    fit.covariance = fit.edge_covariance = Matrix6::Identity() * 1e-8;
    Vec3 places[3];
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 p = pose * depth_places(target)[i];
        places[i] = p * ((p.z + measured_longer_m) / p.z);
    }
    const Vec3 normal = cross(places[1] - places[0], places[2] - places[0]);
    fit.plane.q = normal * (1 / dot(normal, places[0]));
    fit.plane_covariance = Matrix3::Identity() * 1e-10;
    return view;
}

// A camera `degrees` around the middle of the room, at this height, that looks at the middle.
inline Pose ring_camera(double degrees, double radius_m, double height_m = 1.55) {
    const double a = radians_of(degrees);
    return look_at({radius_m * std::sin(a), height_m, radius_m * std::cos(a)}, {0, 1.3, 0},
                   {0, 1, 0});
}

}  // namespace theatron::registration
