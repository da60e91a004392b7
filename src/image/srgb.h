// SPDX-License-Identifier: Apache-2.0
// sRGB values and linear light, both from 0 to 1 (IEC 61966-2-1). Pure.
#pragma once

#include <cmath>

namespace theatron {

inline double srgb_to_linear(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

inline double linear_to_srgb(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

}  // namespace theatron
