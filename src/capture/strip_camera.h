// SPDX-License-Identifier: Apache-2.0
// A camera whose delay is known, and whose pictures tell when they were taken: it sees a board with
// the strip of `theatron photon` (docs/measuring.md).
#pragma once

#include "base/options.h"
#include "capture/camera.h"
#include "capture/clock.h"

namespace theatron::capture {

inline constexpr const char* strip_camera_help =
    "strip  a board that shows this computer's time for 'theatron photon read', seen by a camera "
    "of known delay; strip:delay=75 (milliseconds from exposure until the picture is delivered, "
    "0 to 10000), fps=30";

struct StripCamera {
    Duration delay{};
    double frames_per_second = 30;
};
std::unique_ptr<Camera> make_strip_camera(const StripCamera& wanted, Clock clock);

std::unique_ptr<Camera> open_strip_camera(Options& options, const Progress& progress);

}  // namespace theatron::capture
