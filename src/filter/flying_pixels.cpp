// SPDX-License-Identifier: Apache-2.0
#include "filter/flying_pixels.h"

#include <cassert>

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/flying_pixels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::filter::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void support_rows(const DepthPlane& in, const FlyingPixelRule& rule, DepthPlane& out) {
    const hn::ScalableTag<std::uint16_t> d;
    const int lanes = int(hn::Lanes(d));
    const auto one = hn::Set(d, 1);
    const auto constant = hn::Set(d, rule.tolerance.constant);
    const auto slope = hn::Set(d, rule.tolerance.slope);
    const auto most_lonely = hn::Set(d, std::uint16_t(8 - rule.min_support));

    for (int y = 0; y < in.size().height; ++y) {
        const std::uint16_t* above = in.row(y - 1);
        const std::uint16_t* row = in.row(y);
        const std::uint16_t* below = in.row(y + 1);
        for (int x = 0; x < in.padded_width(); x += lanes) {
            const auto center = hn::LoadU(d, row + x);
            if (hn::AllTrue(d, hn::Eq(center, hn::Zero(d)))) {
                hn::StoreU(center, d, out.row(y) + x);
                continue;
            }
            const auto tolerance = hn::Min(hn::SaturatedAdd(constant, hn::MulHigh(center, slope)),
                                           hn::SaturatedSub(center, one));
            const auto nearest = hn::Sub(center, tolerance);
            const auto furthest = hn::SaturatedAdd(center, tolerance);
            auto lonely = hn::Zero(d);  // neighbours that are too near or too far
            for (const std::uint16_t* p : {above + x - 1, above + x, above + x + 1, row + x - 1,
                                           row + x + 1, below + x - 1, below + x, below + x + 1}) {
                const auto neighbour = hn::LoadU(d, p);
                const auto beyond = hn::Or(hn::SaturatedSub(neighbour, furthest),
                                           hn::SaturatedSub(nearest, neighbour));
                lonely = hn::Add(lonely, hn::Min(beyond, one));
            }
            hn::StoreU(hn::IfThenZeroElse(hn::Gt(lonely, most_lonely), center), d, out.row(y) + x);
        }
    }
}

}  // namespace theatron::filter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace theatron::filter {

HWY_EXPORT(support_rows);

void remove_flying_pixels(const DepthPlane& in, const FlyingPixelRule& rule, DepthPlane& out) {
    assert(in.size() == out.size() && &in != &out);
    HWY_DYNAMIC_DISPATCH(support_rows)(in, rule, out);
}

}  // namespace theatron::filter
#endif
