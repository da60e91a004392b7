// SPDX-License-Identifier: Apache-2.0
// A live Azure Kinect or Orbbec Femto as a camera (docs/cameras.md).
#pragma once

#include "base/options.h"
#include "capture/camera.h"
#include "capture/clock.h"
#include "capture/k4a_library.h"
#include "capture/k4a_settings.h"

namespace theatron::capture {

inline constexpr const char* k4a_camera_help =
    "k4a:INDEX   a live Azure Kinect or Orbbec Femto; serial=NUMBER (instead of INDEX), "
    "depth=nfov|nfov2x2|wfov2x2|wfov, color=720|off|1080|1440|1536|2160|3072, fps=30|15|5, "
    "sync=standalone|master|subordinate, delay_us=0 (of a subordinate), exposure_us=auto|N, "
    "white_balance=auto|N (kelvin), powerline_hz=50|60, synchronized=0 (1: the camera's library "
    "pairs depth with colour and drops what has no partner)";

std::unique_ptr<Camera> open_k4a_camera(Options& options, const Progress& progress);

namespace k4a {

// The time without a frame after which a camera counts as gone.
struct Patience {
    Duration to_begin = 10s;  // sensors and depth engine take seconds to start
    Duration between = 2s;
};

// Starts a camera with given settings and library; its patience and the times at which pictures
// arrive are those of the clock. Throws Error.
std::unique_ptr<Camera> start_camera(const Library& library, const Settings& settings,
                                     const Patience& patience, Clock clock = steady_clock());

}  // namespace k4a
}  // namespace theatron::capture
