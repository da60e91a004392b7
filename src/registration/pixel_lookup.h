// SPDX-License-Identifier: Apache-2.0
// The pixel that sees a direction, from a table: some nanoseconds instead of the lens' polynomial.
#pragma once

#include <vector>

#include "geometry/ray_table.h"

namespace theatron::registration {

class PixelLookup {
public:
    // `rays` is the camera's ray table. Right to a tenth of a pixel for lenses of up to 100
    // degrees.
    PixelLookup(const CameraModel& camera, const Image<Ray>& rays);

    struct Pixel {
        float x = -1, y = -1;  // far outside of the image where no pixel sees the direction
    };
    Pixel at(float x, float y) const {
        const float gx = (x - left_) * per_step_, gy = (y - top_) * per_step_;
        // Also false for NaN.
        if (!(gx >= 0 && gy >= 0 && gx < float(columns_ - 1) && gy < float(rows_ - 1)))
            return {};
        const int cx = int(gx), cy = int(gy);
        const float fx = gx - float(cx), fy = gy - float(cy);
        const Pixel* above = &pixels_[std::size_t(cy * columns_ + cx)];
        const Pixel* below = above + columns_;
        const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
        return {mix(mix(above[0].x, above[1].x, fx), mix(below[0].x, below[1].x, fx), fy),
                mix(mix(above[0].y, above[1].y, fx), mix(below[0].y, below[1].y, fx), fy)};
    }

private:
    float left_ = 0, top_ = 0, per_step_ = 1;
    int columns_ = 0, rows_ = 0;
    std::vector<Pixel> pixels_;
};

}  // namespace theatron::registration
