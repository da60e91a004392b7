// SPDX-License-Identifier: Apache-2.0
// The first filter: removes pixels that are too near, too far or part of the empty scene.
// Both ways of background subtraction reduce to one comparison per pixel.
#pragma once

#include <optional>

#include "filter/background.h"
#include "filter/depth_plane.h"
#include "filter/noise_model.h"

namespace theatron::filter {

// A measurement is kept if it is at least `nearest` and below its pixel's limit.
struct Limits {
    explicit Limits(Size size);

    std::uint16_t nearest = 1;
    DepthPlane furthest;                           // limit per pixel; 0xffff: none
    std::optional<std::uint16_t> common = 0xffff;  // the limit, if all pixels share it

    // Each call narrows the limits. Lengths in the camera's unit.
    void keep_range(int first, int last);
    void remove_background(const Background& background, double margin, double sigmas,
                           const NoiseModel& noise, double unit_mm);
};

// Copies `in` into the plane without the pixels that the limits remove.
void apply_limits(DepthView in, const Limits& limits, DepthPlane& out);
void apply_limits_reference(DepthView in, const Limits& limits, DepthPlane& out);

}  // namespace theatron::filter
