// SPDX-License-Identifier: Apache-2.0
// The region of a depth image that stays exact while the rest is bounded.
#pragma once

#include <cstdint>
#include <vector>

#include "image/view.h"

namespace theatron::codec::strata {

inline constexpr std::size_t max_polygons = 16;
inline constexpr std::size_t max_corners = 32;  // at least 3

// In pixels, on the corners of pixels: (0,0), (w,0), (w,h), (0,h) is the whole
// image.
struct Corner {
    std::uint16_t x = 0, y = 0;
    bool operator==(const Corner&) const = default;
};
using Polygon = std::vector<Corner>;
using Region = std::vector<Polygon>;

inline Polygon box(int left, int top, int right, int bottom) {
    const auto corner = [](int x, int y) { return Corner{std::uint16_t(x), std::uint16_t(y)}; };
    return {corner(left, top), corner(right, top), corner(right, bottom), corner(left, bottom)};
}

// True if there are at most max_polygons polygons of 3 to max_corners corners each.
bool is_valid(const Region& region);

// Sets pixels whose centre is inside a polygon (even-odd rule) to 255, all others
// to 0.
void draw_region(const Region& region, View<std::uint8_t> out);

}  // namespace theatron::codec::strata
