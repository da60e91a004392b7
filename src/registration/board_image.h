// SPDX-License-Identifier: Apache-2.0
// The exact depth image of a lattice board, for tests, measurements and overlays.
#pragma once

#include "geometry/ray_table.h"
#include "registration/lattice_target.h"

namespace theatron::registration {

struct BoardHit {
    float depth_m = 0;        // along the optical axis; 0: the ray misses the board
    float cos_incidence = 0;  // between the surface's normal and the ray
};

// The point of the board that a ray of a camera (direction with z = 1) meets: on a face, the wall
// of a hole, or an outer side.
BoardHit hit_board(const LatticeTarget& target, const Pose& board_from_camera, Ray ray);

// The same for each ray of `rays`.
Image<BoardHit> board_image(const LatticeTarget& target, const Pose& camera_from_board,
                            const Image<Ray>& rays);

}  // namespace theatron::registration
