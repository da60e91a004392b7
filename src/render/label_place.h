// SPDX-License-Identifier: Apache-2.0
// Places for labels in a picture, so that none covers another.
//
// Pure functions; pixels, x to the right and y down from the picture's upper left corner.
#pragma once

#include <vector>

#include "geometry/vec.h"

namespace theatron::render {

struct Rect {
    double x = 0, y = 0, width = 0, height = 0;
    double right() const { return x + width; }
    double bottom() const { return y + height; }
    bool operator==(const Rect&) const = default;
};

// The area that two rectangles share.
double shared_area(const Rect& a, const Rect& b);

// The place for a label of this size beside `at`: inside of `area`, so far away, and where it
// covers the least of what is there already.
Rect label_place(Vec2 at, Vec2 size, double apart, const Rect& area,
                 const std::vector<Rect>& there);

}  // namespace theatron::render
