// SPDX-License-Identifier: Apache-2.0
// An Azure Kinect recording as a camera.
#pragma once

#include "base/options.h"
#include "capture/camera.h"

namespace theatron::capture {

inline constexpr const char* mkv_camera_help =
    "mkv:FILE    an Azure Kinect recording with depth and MJPEG colour; loop=0, start=0 (first "
    "frame), preload=1 (read all at start; usual below 256 MiB)";

std::unique_ptr<Camera> open_mkv_camera(Options& options, const Progress& progress);

}  // namespace theatron::capture
