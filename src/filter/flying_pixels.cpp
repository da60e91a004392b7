// SPDX-License-Identifier: Apache-2.0
#include "filter/flying_pixels.h"

#include <cassert>

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/flying_pixels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "filter/support_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::filter::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void support_rows(const DepthPlane& in, const FlyingPixelRule& rule, DepthPlane& out) {
    const hn::ScalableTag<std::uint16_t> d;
    const int lanes = int(hn::Lanes(d));
    const SupportLanes supported(rule);
    for (int y = 0; y < in.size().height; ++y) {
        const std::uint16_t* row = in.row(y);
        std::uint16_t* out_row = out.row(y);
        for (int x = 0; x < in.padded_width(); x += lanes)
            hn::StoreU(supported(row + x, in.pitch()), d, out_row + x);
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
