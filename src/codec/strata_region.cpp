// SPDX-License-Identifier: Apache-2.0
#include "codec/strata_region.h"

#include <algorithm>
#include <cstring>

namespace theatron::codec::strata {
namespace {

// The intersection of the edge a-b with the line through the centres of row y: the
// first pixel whose centre is not left of it. In integers, so that both sides agree.
int first_right_of(Corner a, Corner b, int y) {
    if (a.y > b.y)
        std::swap(a, b);
    // x + 1/2 >= a.x + (b.x - a.x) (y + 1/2 - a.y) / (b.y - a.y)
    const std::int64_t rise = b.y - a.y;
    const std::int64_t over =
        (2 * std::int64_t(a.x) - 1) * rise + (std::int64_t(b.x) - a.x) * (2 * (y - a.y) + 1);
    const std::int64_t under = 2 * rise;
    return int(over >= 0 ? (over + under - 1) / under : -(-over / under));
}

}  // namespace

bool is_valid(const Region& region) {
    return region.size() <= max_polygons &&
           std::all_of(region.begin(), region.end(), [](const Polygon& polygon) {
               return polygon.size() >= 3 && polygon.size() <= max_corners;
           });
}

void draw_region(const Region& region, View<std::uint8_t> out) {
    const auto [width, height] = out.size;
    std::vector<int> crossings;
    for (int y = 0; y < height; ++y) {
        std::uint8_t* row = out.row(y);
        std::memset(row, 0, std::size_t(width));
        for (const Polygon& polygon : region) {
            crossings.clear();
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const Corner a = polygon[i], b = polygon[(i + 1) % polygon.size()];
                if ((a.y <= y) != (b.y <= y))
                    crossings.push_back(std::clamp(first_right_of(a, b, y), 0, width));
            }
            std::sort(crossings.begin(), crossings.end());
            for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
                std::memset(row + crossings[i], 255, std::size_t(crossings[i + 1] - crossings[i]));
        }
    }
}

}  // namespace theatron::codec::strata
