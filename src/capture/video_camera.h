// SPDX-License-Identifier: Apache-2.0
// A video file as a screen in the room (geometry/screen.h).
#pragma once

#include <string>

#include "base/options.h"
#include "capture/camera.h"

namespace theatron::capture {

inline constexpr const char* video_camera_help =
    "video:FILE  a screen in the room that shows a video (any file that FFmpeg reads); width=1.2 "
    "(metres), loop=0, start=0 (first frame)";

std::unique_ptr<Camera> open_video_camera(Options& options, const Progress& progress);

// The specification of a camera that shares SOURCE, as `--share` takes it: FILE with the options of
// `video`, or a live source (source_camera.h).
std::string camera_of_shared(const std::string& source);

}  // namespace theatron::capture
