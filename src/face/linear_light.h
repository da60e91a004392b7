// SPDX-License-Identifier: Apache-2.0
// Colours as linear light, from 0 to 1.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "image/srgb.h"
#include "image/view.h"

namespace theatron::face {

using Light = std::array<float, 3>;

inline float to_linear(std::uint8_t value) {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> made{};
        for (std::size_t i = 0; i < made.size(); ++i)
            made[i] = float(srgb_to_linear(double(i) / 255));
        return made;
    }();
    return table[value];
}

inline Light to_linear(Rgb color) {
    return {to_linear(color.r), to_linear(color.g), to_linear(color.b)};
}

inline std::uint8_t to_srgb(float light) {
    const double v = light > 0 ? std::min(light, 1.F) : 0;
    return std::uint8_t(255 * linear_to_srgb(v) + 0.5);
}

inline Rgb to_srgb(const Light& light) {
    return {to_srgb(light[0]), to_srgb(light[1]), to_srgb(light[2])};
}

// Between the four nearest pixels; those beyond the border are as those on it. `x` and `y` are of
// the picture, in which the middle of the first pixel is at 0.5.
inline Light sample(ColorView picture, double x, double y) {
    x = std::clamp(x - 0.5, 0.0, double(picture.size.width - 1));
    y = std::clamp(y - 0.5, 0.0, double(picture.size.height - 1));
    const int left = int(x), top = int(y);
    const int right = std::min(left + 1, picture.size.width - 1);
    const int bottom = std::min(top + 1, picture.size.height - 1);
    const auto dx = float(x - left), dy = float(y - top);
    const Light a = to_linear(picture.row(top)[left]), b = to_linear(picture.row(top)[right]),
                c = to_linear(picture.row(bottom)[left]), d = to_linear(picture.row(bottom)[right]);
    Light mixed{};
    for (std::size_t k = 0; k < 3; ++k)
        mixed[k] = (1 - dy) * ((1 - dx) * a[k] + dx * b[k]) + dy * ((1 - dx) * c[k] + dx * d[k]);
    return mixed;
}

}  // namespace theatron::face
