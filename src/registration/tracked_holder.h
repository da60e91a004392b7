// SPDX-License-Identifier: Apache-2.0
// The room's frame from the board in a holder on a tracked controller.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "registration/lattice_target.h"

namespace theatron::registration {

struct HolderPose {
    int place = 0;  // of the board, from 0 on, as BoardSession counts them
    Pose room_from_controller;
};

// Lines "PLACE X Y Z QW QX QY QZ", places from 1 on: the controller in the room while the board was
// there. Empty lines and those that begin with # are left out. `problem` is a sentence about the
// first line that is not understood.
struct ParsedHolder {
    std::vector<HolderPose> poses;
    std::string problem;
};
ParsedHolder parse_holder(std::string_view text);

struct HolderFit {
    Pose room_from_reference;
    double rms_m = 0;     // of the board's corners, by the controller and by the cameras
    std::string problem;  // a sentence if they do not agree; the rest is unspecified then
};

// `reference_from_board` is RigSolution's, by place; `controller_from_board` is the holder's
// measured offset. One place is enough, more average the errors of both.
HolderFit fit_holder(const LatticeTarget& target, std::span<const Pose> reference_from_board,
                     const Pose& controller_from_board, std::span<const HolderPose> poses);

}  // namespace theatron::registration
