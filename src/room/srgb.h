// SPDX-License-Identifier: Apache-2.0
// Linear colours, 0 to 1, as bytes of a picture.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "geometry/vec.h"
#include "image/view.h"

namespace theatron::room {

inline Rgb srgb_of(Vec3 linear) {
    const auto byte = [](double v) {
        return std::uint8_t(std::lround(std::clamp(std::pow(v, 1 / 2.2), 0.0, 1.0) * 255));
    };
    return {byte(linear.x), byte(linear.y), byte(linear.z)};
}

}  // namespace theatron::room
