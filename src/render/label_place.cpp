// SPDX-License-Identifier: Apache-2.0
#include "render/label_place.h"

#include <algorithm>
#include <limits>

namespace theatron::render {

double shared_area(const Rect& a, const Rect& b) {
    const double width = std::min(a.right(), b.right()) - std::max(a.x, b.x);
    const double height = std::min(a.bottom(), b.bottom()) - std::max(a.y, b.y);
    return width > 0 && height > 0 ? width * height : 0;
}

Rect label_place(Vec2 at, Vec2 size, double apart, const Rect& area,
                 const std::vector<Rect>& there) {
    const auto kept = [](double value, double least, double most) {
        return std::clamp(value, least, std::max(least, most));
    };
    Rect best;
    double least = std::numeric_limits<double>::infinity();
    // Near places first; at each distance below and to the right first.
    for (const double reach : {1.0, 2.5, 4.0})
        for (const int down : {1, 0, -1})
            for (const int right : {1, -1, 0}) {
                if (down == 0 && right == 0)
                    continue;
                const auto begin = [&](double middle, double length, int side) {
                    return middle + side * reach * apart - (1 - side) * length / 2;
                };
                const Rect label{kept(begin(at.x, size.x, right), area.x, area.right() - size.x),
                                 kept(begin(at.y, size.y, down), area.y, area.bottom() - size.y),
                                 size.x, size.y};
                double covers = 0;
                // A label that covers no less than the best one is not looked at any further.
                for (const Rect& other : there)
                    if ((covers += shared_area(label, other)) >= least)
                        break;
                if (covers < least) {
                    best = label;
                    least = covers;
                }
                if (least == 0)
                    return best;
            }
    return best;
}

}  // namespace theatron::render
