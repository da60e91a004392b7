// SPDX-License-Identifier: Apache-2.0
// Checks a host's description of its cameras before a participant allocates memory for them.
#pragma once

#include <string>
#include <vector>

#include "wire/control.h"

namespace theatron::session {

// Limits for all cameras of a host together. With the limits of one camera (geometry/calibration.h)
// they bound the memory of a participant; see "Memory" in docs/formats/connection.md.
inline constexpr std::size_t max_total_depth_pixels = std::size_t(16) << 20;
inline constexpr std::size_t max_total_color_pixels = std::size_t(64) << 20;

struct AnnouncedCameras {
    std::vector<wire::Camera> accepted;
    std::vector<wire::Text> left_out;  // one about each other camera
};

// Streams have 16-bit numbers, and a camera has two of them.
inline constexpr int max_camera_number = 0x7fff;

// Leaves out cameras beyond wire::max_cameras, those whose number is beyond max_camera_number or
// used twice, whose streams are not theirs (depth_stream(), color_stream()), whose frame rate is
// not from 0 to 1000, whose calibration decode_calibration() refuses or that has no depth, and
// those that exceed the limits above. Order is kept.
AnnouncedCameras judge_cameras(std::vector<wire::Camera> announced);

}  // namespace theatron::session
