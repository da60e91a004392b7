// SPDX-License-Identifier: Apache-2.0
// What a host says of its cameras, judged before a participant takes memory for them.
#pragma once

#include <string>
#include <vector>

#include "wire/control.h"

namespace theatron::session {

// Of all cameras of a host together. With the limits of one (geometry/calibration.h) they bound
// what a host can make a participant take; see "Memory" in docs/formats/connection.md.
inline constexpr std::size_t max_total_depth_pixels = std::size_t(16) << 20;
inline constexpr std::size_t max_total_color_pixels = std::size_t(64) << 20;

// Viewers keep the pictures of all cameras in arrays as wide and as high as the widest and the
// highest: these are at most so many times as large as one camera's may be.
inline constexpr std::size_t max_array_factor = 2;

struct AnnouncedCameras {
    std::vector<wire::Camera> accepted;
    std::vector<std::string> left_out;  // one sentence for the user about each other one
};

// Streams have 16-bit numbers, and a camera has two of them.
inline constexpr int max_camera_number = 0x7fff;

// Leaves out cameras beyond wire::max_cameras, those whose number is beyond all or given twice,
// whose streams are not theirs (depth_stream(), color_stream()), whose frame rate is no rate, whose
// calibration is refused by decode_calibration(), and those that exceed what is said above. Order
// is kept.
AnnouncedCameras judge_cameras(std::vector<wire::Camera> announced);

}  // namespace theatron::session
