// SPDX-License-Identifier: Apache-2.0
// Finds the lattice's pattern on a plane: its face, its orientation, and its place
// to within a centimetre.
#pragma once

#include <optional>

#include "registration/lattice_target.h"
#include "registration/rectified.h"

namespace theatron::registration {

struct LatticeMatch {
    Face face = Face::front;
    Pose camera_from_face;
    // The share of the known part of the face and of a rim around it that agrees with
    // the pattern, 0.5 to 1.
    double agreement = 0;
    double known = 0;   // share of face and rim for which the depth image has evidence
    double margin = 0;  // lead over the best of the other three orientations of the board
};

// The best match on `found`, or nothing if no place agrees well enough.
std::optional<LatticeMatch> match_lattice(const DepthLookup& depth, const FoundPlane& found,
                                          const LatticeTarget& target);

}  // namespace theatron::registration
