// SPDX-License-Identifier: Apache-2.0
#include "filter/limits.h"

#include <algorithm>
#include <cassert>
#include <cmath>

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/limits.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "filter/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::filter::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void limit_rows(DepthView in, const Limits& limits, DepthPlane& out) {
    const hn::ScalableTag<std::uint16_t> d;
    const int lanes = int(hn::Lanes(d));
    const auto nearest = hn::Set(d, limits.nearest);
    // A single number takes less memory bandwidth than an image of equal ones.
    const bool one_limit = limits.common.has_value();
    const auto common = hn::Set(d, limits.common.value_or(0));
    for (int y = 0; y < in.size.height; ++y) {
        const std::uint16_t* row = in.row(y);
        const std::uint16_t* furthest = limits.furthest.row(y);
        std::uint16_t* out_row = out.row(y);
        int x = 0;
        for (; x + lanes <= in.size.width; x += lanes) {
            const auto depth = hn::LoadU(d, row + x);
            const auto limit = one_limit ? common : hn::LoadU(d, furthest + x);
            const auto goes = hn::Or(hn::Lt(depth, nearest), at_least(depth, limit));
            hn::StoreU(hn::IfThenZeroElse(goes, depth), d, out_row + x);
        }
        for (; x < in.size.width; ++x) {
            const bool stays = row[x] >= limits.nearest && row[x] < furthest[x];
            out_row[x] = stays ? row[x] : std::uint16_t(0);
        }
    }
}

}  // namespace theatron::filter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace theatron::filter {
namespace {

constexpr std::uint16_t no_limit = 0xffff;

template <class Limit>
void narrow(DepthPlane& furthest, Limit limit) {
    for (int y = 0; y < furthest.size().height; ++y)
        for (int x = 0; x < furthest.size().width; ++x) {
            std::uint16_t& pixel = furthest.row(y)[x];
            pixel = std::uint16_t(std::clamp<long>(limit(x, y), 0, pixel));
        }
}

}  // namespace

HWY_EXPORT(limit_rows);

Limits::Limits(Size size) : furthest(size) {
    for (int y = 0; y < size.height; ++y)
        std::fill_n(furthest.row(y), size.width, no_limit);
}

void Limits::keep_range(int first, int last) {
    nearest = std::uint16_t(std::clamp<int>(first, nearest, 0xffff));
    narrow(furthest, [&](int, int) { return last + 1l; });
    if (common)
        common = std::uint16_t(std::min<int>(*common, last + 1));
}

void Limits::remove_background(const Background& background, double margin, double sigmas,
                               const NoiseModel& noise, double unit_mm) {
    if (background.nearest.size != furthest.size())
        return;
    common.reset();
    narrow(furthest, [&](int x, int y) -> long {
        const std::uint16_t empty = background.nearest.view().row(y)[x];
        if (empty == 0)
            return no_limit;
        const double mm = empty * background.depth_unit_mm, metres = mm / 1000;
        const double sigma = noise.constant_mm + noise.squared_mm * metres * metres;
        return std::lround((mm - margin * unit_mm - sigmas * sigma) / unit_mm);
    });
}

void apply_limits(DepthView in, const Limits& limits, DepthPlane& out) {
    assert(in.size == out.size() && in.size == limits.furthest.size());
    HWY_DYNAMIC_DISPATCH(limit_rows)(in, limits, out);
}

}  // namespace theatron::filter
#endif
