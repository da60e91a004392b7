// SPDX-License-Identifier: Apache-2.0
// The first filter: what is too near, too far or part of the empty scene goes.
// Both of background subtraction's ways come down to one comparison per pixel.
#pragma once

#include <optional>

#include "filter/background.h"
#include "filter/depth_plane.h"
#include "filter/noise_model.h"

namespace theatron::filter {

// A measurement stays if it is at least `nearest` and less than its pixel's limit.
struct Limits {
    explicit Limits(Size size);

    std::uint16_t nearest = 1;
    DepthPlane furthest;                           // 0xffff in the image where there is no limit
    std::optional<std::uint16_t> common = 0xffff;  // the limit, where all pixels have the same

    // Each narrows what stays. Lengths in the camera's unit.
    void keep_range(int first, int last);
    void remove_background(const Background& background, double margin, double sigmas,
                           const NoiseModel& noise, double unit_mm);
};

// Copies `in`, without what the limits remove, into the plane.
void apply_limits(DepthView in, const Limits& limits, DepthPlane& out);
void apply_limits_reference(DepthView in, const Limits& limits, DepthPlane& out);

}  // namespace theatron::filter
