// SPDX-License-Identifier: Apache-2.0
// Grey pictures, as strips are looked for in.
#pragma once

#include <optional>

#include "image/image.h"
#include "photon/plane_map.h"

namespace theatron::photon {

using GreyImage = Image<std::uint8_t>;
using GreyView = View<const std::uint8_t>;

// Brightness of each pixel (the luma of ITU-R BT.601). `out` keeps its memory.
void grey_of(ColorView color, GreyImage& out);

// Each pixel is the mean of 2 x 2; a last odd row or column is left out. Both sides of `in` have at
// least 2 pixels.
void halve(GreyView in, GreyImage& out);

// The brightness between pixels, whose middles are at whole coordinates plus a half; nullopt
// outside.
inline std::optional<double> brightness_at(GreyView grey, Point place) {
    const double x = place.x - 0.5, y = place.y - 0.5;
    if (!(x >= 0 && y >= 0 && x < grey.size.width - 1 && y < grey.size.height - 1))
        return std::nullopt;
    const int left = int(x), top = int(y);
    const double right_share = x - left, lower_share = y - top;
    const std::uint8_t* const upper = grey.row(top) + left;
    const std::uint8_t* const lower = grey.row(top + 1) + left;
    return (upper[0] * (1 - right_share) + upper[1] * right_share) * (1 - lower_share) +
           (lower[0] * (1 - right_share) + lower[1] * right_share) * lower_share;
}

}  // namespace theatron::photon
