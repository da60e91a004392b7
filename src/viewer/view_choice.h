// SPDX-License-Identifier: Apache-2.0
// A viewpoint of the command line: camera:N,yaw=…,pitch=…
#pragma once

#include <map>
#include <string>

#include "receive/receiver.h"
#include "render/camera_view.h"

namespace theatron::viewer {

struct ViewChoice {
    CameraId camera{};
    double yaw_degrees = 0, pitch_degrees = 0;

    // Throws Error if there is no such camera or nothing came from it yet.
    render::CameraView resolve(const std::map<CameraId, Calibration>& calibrations,
                               const std::map<CameraId, receive::CameraFramePtr>& newest,
                               Size picture) const;
};

// Throws Error with one sentence if the text is wrong.
ViewChoice parse_view(const std::string& text);

}  // namespace theatron::viewer
