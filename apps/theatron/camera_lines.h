// SPDX-License-Identifier: Apache-2.0
// Lines of standard input with which operators adjust cameras for all: of `theatron join`, and of
// `theatron host` for the person at the host's machine.
#pragma once

#include <string>
#include <vector>

#include "client/participant.h"
#include "host/host.h"

namespace theatron::app {

const char* camera_lines_help();

struct AdjustLine {
    std::size_t camera = 0;  // of those that were passed
    session::CameraAdjustment adjustment;
};
// Reads "nudge CAMERA X Y Z [TILT TURN ROLL]" in millimetres along the room's axes and degrees
// about them, "nudge CAMERA none", "crop CAMERA X:Y:WxH" in pixels of its depth picture, or "crop
// CAMERA none". CAMERA is a number from 0 or a name; `now`: the cameras'
// adjustments, whose other parts stay. nullopt if it is no such line. Throws Error with one
// sentence if it is wrong.
std::optional<AdjustLine> parse_adjust_line(const std::string& line,
                                            const std::vector<std::string>& names,
                                            const std::vector<session::CameraAdjustment>& now);

// Carries out such a line; false if it is none. A sentence on a wrong line is printed.
bool obey_camera_line(client::Participant& participant, const std::string& line);
bool obey_camera_line(host::Host& host, const std::string& line);

}  // namespace theatron::app
