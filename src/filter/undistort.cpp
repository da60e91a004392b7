// SPDX-License-Identifier: Apache-2.0
#include "filter/undistort.h"

#include <cassert>
#include <cmath>

namespace theatron::filter {
namespace {

constexpr int one = 256, half = 128;

}  // namespace

CameraModel without_distortion(const CameraModel& camera) {
    CameraModel plain = camera;
    plain.k = {};
    plain.p1 = plain.p2 = 0;
    return plain;
}

Undistortion::Undistortion(const CameraModel& from, const CameraModel& to)
    : from_(from.size), to_(to.size), sources_(to.size.area(), Source{-1, -1}) {
    for (int y = 0; y < to.size.height; ++y)
        for (int x = 0; x < to.size.width; ++x) {
            const auto ray = unproject(to, {double(x), double(y)});
            const auto pixel = ray ? project(from, {ray->x, ray->y, 1}) : std::nullopt;
            if (!pixel || !(std::abs(pixel->x) <= from.size.width) ||
                !(std::abs(pixel->y) <= from.size.height))
                continue;
            // Rounding may put border pixels outside; they still count as inside.
            const Source source{std::int32_t(std::lround(pixel->x * one)),
                                std::int32_t(std::lround(pixel->y * one))};
            if (source.x >= 0 && source.x <= (from.size.width - 1) * one && source.y >= 0 &&
                source.y <= (from.size.height - 1) * one)
                sources_[std::size_t(y) * std::size_t(to.size.width) + std::size_t(x)] = source;
        }
}

void Undistortion::apply(DepthView in, MutableDepthView out) const {
    assert(in.size == from_ && out.size == to_);
    const Source* source = sources_.data();
    for (int y = 0; y < to_.height; ++y)
        for (int x = 0; x < to_.width; ++x, ++source)
            out.row(y)[x] = source->x < 0
                                ? std::uint16_t(0)
                                : in.row((source->y + half) / one)[(source->x + half) / one];
}

void Undistortion::apply(ColorView in, MutableColorView out) const {
    assert(in.size == from_ && out.size == to_);
    const Source* source = sources_.data();
    for (int y = 0; y < to_.height; ++y)
        for (int x = 0; x < to_.width; ++x, ++source) {
            if (source->x < 0) {
                out.row(y)[x] = {};
                continue;
            }
            const int left = source->x / one, top = source->y / one;
            const int u = source->x % one, v = source->y % one;
            // With a fraction of zero, the next pixel is not read and may not exist.
            const Rgb* above = in.row(top) + left;
            const Rgb* below = in.row(v == 0 ? top : top + 1) + left;
            const int right = u == 0 ? 0 : 1;
            const auto mixed = [&](std::uint8_t Rgb::*c) {
                const int upper = above[0].*c * (one - u) + above[right].*c * u;
                const int lower = below[0].*c * (one - u) + below[right].*c * u;
                return std::uint8_t((upper * (one - v) + lower * v + one * half) / (one * one));
            };
            out.row(y)[x] = {mixed(&Rgb::r), mixed(&Rgb::g), mixed(&Rgb::b)};
        }
}

}  // namespace theatron::filter
