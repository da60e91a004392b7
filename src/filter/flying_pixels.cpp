// SPDX-License-Identifier: Apache-2.0
#include "filter/flying_pixels.h"

#include <cassert>

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/flying_pixels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "filter/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::filter::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void support_rows(const DepthPlane& in, const FlyingPixelRule& rule, DepthPlane& out) {
    const hn::ScalableTag<std::uint16_t> d;
    const int lanes = int(hn::Lanes(d));
    const auto zero = hn::Zero(d);
    const auto one = hn::Set(d, 1);
    const auto constant = hn::Set(d, rule.tolerance.constant);
    const auto slope = hn::Set(d, rule.tolerance.slope);
    const auto min_support = hn::Set(d, std::uint16_t(rule.min_support));

    for (int y = 0; y < in.size().height; ++y) {
        const std::uint16_t* above = in.row(y - 1);
        const std::uint16_t* row = in.row(y);
        const std::uint16_t* below = in.row(y + 1);
        for (int x = 0; x < in.padded_width(); x += lanes) {
            const auto center = hn::LoadU(d, row + x);
            const auto tolerance = hn::Min(hn::SaturatedAdd(constant, hn::MulHigh(center, slope)),
                                           hn::SaturatedSub(center, one));
            auto support = zero;
            for (const std::uint16_t* p : {above + x - 1, above + x, above + x + 1, row + x - 1,
                                           row + x + 1, below + x - 1, below + x, below + x + 1}) {
                const auto neighbour = hn::LoadU(d, p);
                const auto step = hn::Sub(hn::Max(neighbour, center), hn::Min(neighbour, center));
                // A mask is -1 in each lane.
                support = hn::Sub(support, hn::VecFromMask(d, at_most(step, tolerance)));
            }
            const auto lonely = hn::Lt(support, min_support);
            hn::StoreU(hn::IfThenZeroElse(lonely, center), d, out.row(y) + x);
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
