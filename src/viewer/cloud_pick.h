// SPDX-License-Identifier: Apache-2.0
// The place of the live clouds that a ray meets first, as the depth cameras measured it.
//
// Pure functions; room coordinates, metres.
#pragma once

#include <optional>
#include <vector>

#include "geometry/calibration.h"
#include "image/view.h"
#include "render/pick.h"
#include "room/measured_distance.h"

namespace theatron::viewer {

// The newest picture of a camera of the room. Both must outlive it.
struct CloudCamera {
    std::uint32_t number = 0;
    const Calibration* calibration = nullptr;
    DepthView depth;
};

struct CloudPoint {
    room::MeasuredPoint measured;
    Vec3 place, normal;  // the normal has length 1 and points to the side of the camera
    double distance_m = 0;
};

// Nullopt if the ray meets no surface within farthest_pick_m that a camera saw. The deviation of a
// point is that of one depth measurement; filters over time make it smaller.
inline constexpr double farthest_pick_m = 8;
std::optional<CloudPoint> pick_cloud(const std::vector<CloudCamera>& cameras,
                                     const render::PickRay& ray);

}  // namespace theatron::viewer
