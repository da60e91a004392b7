// SPDX-License-Identifier: Apache-2.0
// The pixels of a triangle, and their depths. Pure.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/vec.h"
#include "image/view.h"

namespace theatron::face {

// Calls visit(x, y, shares) for each pixel of a picture of this size whose middle is inside of the
// triangle or on its edge; `shares` are those of its corners. Corners that are no finite numbers
// make no pixel.
template <class Visit>
void raster(const std::array<Vec2, 3>& corners, Size size, Visit&& visit) {
    const auto [a, b, c] = corners;
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (!(std::fabs(area) > 1e-9) || !std::isfinite(area))
        return;
    const auto first = [](double low) { return int(std::clamp(std::floor(low), 0.0, 1e6)); };
    const auto last = [](double high, int side) {
        return int(std::clamp(std::ceil(high), 0.0, double(side)));
    };
    const int right = last(std::max({a.x, b.x, c.x}), size.width);
    const int bottom = last(std::max({a.y, b.y, c.y}), size.height);
    const int left = first(std::min({a.x, b.x, c.x}));
    for (int y = first(std::min({a.y, b.y, c.y})); y < bottom; ++y)
        for (int x = left; x < right; ++x) {
            const double px = x + 0.5, py = y + 0.5;
            const double of_b = ((px - a.x) * (c.y - a.y) - (c.x - a.x) * (py - a.y)) / area;
            const double of_c = ((b.x - a.x) * (py - a.y) - (px - a.x) * (b.y - a.y)) / area;
            if (of_b >= 0 && of_c >= 0 && of_b + of_c <= 1)
                visit(x, y, std::array<double, 3>{1 - of_b - of_c, of_b, of_c});
        }
}

// Shares of the corners in space from those in a picture, and the depth there: corners have depths
// `z`, all positive.
inline double to_space(std::array<double, 3>& shares, const std::array<double, 3>& z) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
        sum += shares[k] /= z[k];
    for (double& share : shares)
        share /= sum;
    return 1 / sum;
}

}  // namespace theatron::face
