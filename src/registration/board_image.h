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

// What one ray of a camera (its direction with z = 1) meets: a face, the wall of a hole, an outer
// side.
BoardHit hit_board(const LatticeTarget& target, const Pose& board_from_camera, Ray ray);

// For each ray of `rays`.
Image<BoardHit> board_image(const LatticeTarget& target, const Pose& camera_from_board,
                            const Image<Ray>& rays);

}  // namespace theatron::registration
