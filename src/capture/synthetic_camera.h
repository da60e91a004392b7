// SPDX-License-Identifier: Apache-2.0
// A camera in the synthetic operating room (synthetic/operating_room.h).
#pragma once

#include "base/options.h"
#include "capture/camera.h"

namespace theatron::capture {

inline constexpr const char* synthetic_camera_help =
    "synthetic  an operating room made by this program, in a loop that is rendered once and kept; "
    "synthetic:surgeon looks at the surgeon; camera=0, cameras=2 (up to 12 around the table), "
    "seed=1, color=720 (or 1080, depth, off), noise=on (off: exact depth), "
    "people=on (off: the empty room, for 'background record'), seconds=20, fps=30, "
    "loop=1, start=0, quality=full (or quick: coarse and small, for a first try), cache=DIR, "
    "preload=0 (1: kept in memory, for benchmarks)";

std::unique_ptr<Camera> open_synthetic_camera(Options& options, const Progress& progress);

}  // namespace theatron::capture
