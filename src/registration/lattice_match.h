// SPDX-License-Identifier: Apache-2.0
// Finds the lattice's pattern on a plane: which face, which way up, and where to
// within a centimetre.
#pragma once

#include <optional>

#include "registration/lattice_target.h"
#include "registration/rectified.h"

namespace theatron::registration {

struct LatticeMatch {
    Face face = Face::front;
    Pose camera_from_face;
    // Of what the depth image says about the face and a rim around it, the share
    // that agrees with the pattern, 0.5 to 1.
    double agreement = 0;
    double known = 0;   // share of face and rim that the depth image says something about
    double margin = 0;  // lead over the best of the other three ways to see the board
};

// The best match on `found`, or nothing where no place agrees well enough.
std::optional<LatticeMatch> match_lattice(const DepthLookup& depth, const FoundPlane& found,
                                          const LatticeTarget& target);

}  // namespace theatron::registration
