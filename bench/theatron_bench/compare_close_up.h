// SPDX-License-Identifier: Apache-2.0
// The part of a camera's picture that shows one place of the room from nearby.
#pragma once

#include <optional>

#include "capture/crop.h"
#include "geometry/calibration.h"

namespace theatron::bench {

// The part of a colour picture of size `picture` around `point_room`, `width_m` wide at that
// distance and as high as the proportions of the picture say. It is moved to lie in the picture.
// Nullopt if the picture does not show the point, or less than the part.
std::optional<capture::Crop> part_around(const Calibration& calibration, Size picture,
                                         Vec3 point_room, double width_m);

}  // namespace theatron::bench
