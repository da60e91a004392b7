// SPDX-License-Identifier: Apache-2.0
// Finds the lattice target in depth images of one camera.
//
// Planes of the right size are searched, the pattern is looked for on each, and
// the board's pose is fitted to the pixels. Some milliseconds for 640x576
// pixels on one core. One detector per thread.
#pragma once

#include <optional>

#include "registration/lattice_fit.h"
#include "registration/lattice_target.h"

namespace theatron::registration {

struct Detection {
    Pose camera_from_board;
    LatticeMatch match;
    LatticeFit fit;
};

class LatticeDetector {
public:
    // `target` must be valid.
    LatticeDetector(const CameraModel& camera, double depth_unit_mm, const LatticeTarget& target);

    // `depth` must have the camera's size. Empty if the board is not seen well enough.
    std::optional<Detection> detect(DepthView depth, FitEffort effort = FitEffort::find);

private:
    CameraModel camera_;
    double metres_per_unit_;
    LatticeTarget target_;
    Image<Ray> rays_, sparse_rays_;
    PixelLookup pixels_;
    SparseDepth sparse_;
    std::vector<std::uint8_t> explained_;
};

}  // namespace theatron::registration
