// SPDX-License-Identifier: Apache-2.0
#include "registration/pixel_lookup.h"

#include <algorithm>
#include <cmath>

namespace theatron::registration {
namespace {

constexpr int steps_across = 128;
constexpr int most_rows = 1024;

}  // namespace

PixelLookup::PixelLookup(const CameraModel& camera, const Image<Ray>& rays) {
    float right = -no_ray, bottom = -no_ray;
    left_ = top_ = no_ray;
    for (const Ray ray : rays.pixels) {
        if (ray.x == no_ray)
            continue;
        left_ = std::min(left_, ray.x);
        right = std::max(right, ray.x);
        top_ = std::min(top_, ray.y);
        bottom = std::max(bottom, ray.y);
    }
    if (!(left_ < right && top_ < bottom))
        return;  // no pixel sees anything
    const float step = std::max((right - left_) / steps_across, (bottom - top_) / most_rows);
    per_step_ = 1 / step;
    columns_ = int(std::ceil((right - left_) / step)) + 1;
    rows_ = int(std::ceil((bottom - top_) / step)) + 1;
    for (int y = 0; y < rows_; ++y)
        for (int x = 0; x < columns_; ++x) {
            const auto pixel = project(
                camera, {double(left_ + float(x) * step), double(top_ + float(y) * step), 1});
            constexpr float nowhere = -1e6f;
            pixels_.push_back(pixel ? Pixel{float(pixel->x), float(pixel->y)}
                                    : Pixel{nowhere, nowhere});
        }
}

}  // namespace theatron::registration
