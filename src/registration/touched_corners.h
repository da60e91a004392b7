// SPDX-License-Identifier: Apache-2.0
// The room's frame from a tracked controller whose tip is held to corners of the board.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "registration/lattice_target.h"

namespace theatron::registration {

// Corners of the front face, clockwise as seen from there: A is the one with the three filled cells
// (upper left), B upper right, C lower right, D lower left. Board frame.
std::array<Vec3, 4> board_corners(const LatticeTarget& target);

struct Touch {
    int corner = 0;  // 0 is A
    Vec3 room;       // of the tip, metres
};

// Lines "CORNER X Y Z" or "CORNER X Y Z QW QX QY QZ": position and rotation of the controller in
// the room. `tip` is the tip in the controller's frame; unless it is zero, each line needs a
// rotation. Empty lines and those that begin with # are left out. `problem` is a sentence about the
// first line that is not understood.
struct ParsedTouches {
    std::vector<Touch> touches;
    std::string problem;
};
ParsedTouches parse_touches(std::string_view text, Vec3 tip);

struct TouchFit {
    Pose room_from_board;
    double rms_m = 0;     // of the touches from the corners
    std::string problem;  // a sentence if the touches are no board; the rest is unspecified then
};

// At least three corners, each touched once or more.
TouchFit fit_touches(const LatticeTarget& target, const std::vector<Touch>& touches);

}  // namespace theatron::registration
