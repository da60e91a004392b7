// SPDX-License-Identifier: Apache-2.0
// The result of a registration: places of cameras for the file, the terminal and the report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "capture/camera_places.h"
#include "depth_source.h"
#include "registration/board_session.h"
#include "registration/registration_report.h"

namespace theatron::app {

using Cameras = std::vector<DepthSource::Camera>;

struct RoomFrame {
    Pose room_from_reference;
    std::string source;  // for sentences: "the room's frame comes from ..."
};

struct RegisteredRig {
    capture::CameraPlaces places;
    std::string room;  // what the room's frame comes from
    registration::RegistrationReport report;
};

struct RigOutput {
    std::string places, report;  // files; no report where it is empty
    bool json = false;
};

// From views of the board, improved on the scene's surfaces where that helps. `solution` must have
// no problem.
//
// The room's frame is `given`, else comes from the first camera's own place, else from the floor.
RegisteredRig rig_of_board(const Cameras& cameras, const registration::BoardSession& session,
                           const registration::RigSolution& solution, const std::string& method,
                           const std::optional<RoomFrame>& given);

// From the places of `earlier`, improved on surfaces; `means` by camera. Throws Error if a camera
// has no place there, or if no better places were found.
RegisteredRig rig_of_surfaces(const Cameras& cameras, const capture::CameraPlaces& earlier,
                              const std::vector<registration::FrameMean>& means);

// The beginning of a line on standard output that stands in place of the one that is there; empty
// where the output is no terminal.
const char* clear_line();

// Writes the files, and a summary to standard output.
void save(const RegisteredRig& rig, const RigOutput& output);

}  // namespace theatron::app
