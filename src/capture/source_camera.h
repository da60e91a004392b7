// SPDX-License-Identifier: Apache-2.0
// Live screens in the room (geometry/screen.h): a window or the display, a video device, a network
// stream. Each is read by a child process that has its one connection and nothing else.
#pragma once

#include <string>

#include "base/options.h"
#include "capture/camera.h"

namespace theatron::capture {

inline constexpr const char* x11_camera_help =
    "x11:WINDOW  a screen in the room that shows a window of this display (its number or a part of "
    "its title) or, as x11:display, all of it; width=1.2 (metres), fps=30, cursor=1, name";
inline constexpr const char* v4l2_camera_help =
    "v4l2:DEVICE  a screen in the room that shows a video device, for example v4l2:/dev/video0; "
    "width=1.2, size=WxH, fps=30, name";
inline constexpr const char* rtsp_camera_help =
    "rtsp://HOST/PATH  a screen in the room that shows a network stream; width=1.2, name";

std::unique_ptr<Camera> open_x11_camera(Options& options, const Progress& progress);
std::unique_ptr<Camera> open_v4l2_camera(Options& options, const Progress& progress);
std::unique_ptr<Camera> open_rtsp_camera(Options& options, const Progress& progress);

}  // namespace theatron::capture
