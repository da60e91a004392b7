// SPDX-License-Identifier: Apache-2.0
#include "filter/color_registration.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace theatron::filter {
namespace {

// A depth pixel this close behind the nearest surface belongs to that surface.
constexpr float same_surface_m = 0.02f;
constexpr float same_surface_share = 0.02f;

}  // namespace

ColorRegistration::ColorRegistration(const Calibration& calibration)
    : calibration_(calibration),
      rays_(make_ray_table(calibration.depth)),
      cell_(std::max(1, int(std::ceil(1.5 * calibration.color.fx / calibration.depth.fx)))),
      cells_{calibration.color.size.width / cell_ + 1, calibration.color.size.height / cell_ + 1},
      places_(calibration.depth.size.area()),
      nearest_(cells_.area()) {}

void ColorRegistration::project_all(DepthView depth) {
    const Size color = calibration_.color.size;
    std::fill(nearest_.begin(), nearest_.end(), std::numeric_limits<float>::max());
    for (int y = 0; y < depth.size.height; ++y)
        for (int x = 0; x < depth.size.width; ++x) {
            Place& place = places_[std::size_t(y) * std::size_t(depth.size.width) + std::size_t(x)];
            place = {};
            const Ray ray = rays_.view().row(y)[x];
            const double z = depth.row(y)[x] * calibration_.depth_unit_mm / 1000;
            if (z == 0 || ray.x >= no_ray)
                continue;
            const Vec3 point = calibration_.color_from_depth * Vec3{ray.x * z, ray.y * z, z};
            const auto pixel = project(calibration_.color, point);
            if (!pixel || !(pixel->x > -0.5 && pixel->x < color.width - 0.5) ||
                !(pixel->y > -0.5 && pixel->y < color.height - 0.5))
                continue;
            place = {int(std::lround(pixel->x)), int(std::lround(pixel->y)), float(point.z)};
            float& nearest = nearest_[std::size_t(place.y / cell_) * std::size_t(cells_.width) +
                                      std::size_t(place.x / cell_)];
            nearest = std::min(nearest, place.z);
        }
}

void ColorRegistration::apply(DepthView depth, ColorView color, MutableColorView out,
                              View<std::uint8_t> seen) {
    assert(depth.size == calibration_.depth.size && color.size == calibration_.color.size);
    assert(out.size == depth.size && seen.size == depth.size);
    project_all(depth);
    const Place* place = places_.data();
    for (int y = 0; y < depth.size.height; ++y)
        for (int x = 0; x < depth.size.width; ++x, ++place) {
            out.row(y)[x] = {};
            seen.row(y)[x] = 0;
            if (place->x < 0)
                continue;
            // Includes the neighbouring cells: a surface may hide pixels across a cell's border.
            const float limit = place->z - same_surface_m - same_surface_share * place->z;
            bool hidden = false;
            for (int cy = std::max(0, place->y / cell_ - 1);
                 cy <= std::min(cells_.height - 1, place->y / cell_ + 1); ++cy)
                for (int cx = std::max(0, place->x / cell_ - 1);
                     cx <= std::min(cells_.width - 1, place->x / cell_ + 1); ++cx)
                    hidden |=
                        nearest_[std::size_t(cy) * std::size_t(cells_.width) + std::size_t(cx)] <
                        limit;
            if (hidden)
                continue;
            out.row(y)[x] = color.row(place->y)[place->x];
            seen.row(y)[x] = 255;
        }
}

}  // namespace theatron::filter
