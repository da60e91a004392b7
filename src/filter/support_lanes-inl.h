// SPDX-License-Identifier: Apache-2.0
// supported_or_none() for a vector of pixels. Included once per instruction set.
#if defined(THEATRON_FILTER_SUPPORT_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef THEATRON_FILTER_SUPPORT_LANES_INL_H
#undef THEATRON_FILTER_SUPPORT_LANES_INL_H
#else
#define THEATRON_FILTER_SUPPORT_LANES_INL_H
#endif

#include "filter/flying_pixels.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::filter::HWY_NAMESPACE {

class SupportLanes {
    static constexpr hwy::HWY_NAMESPACE::ScalableTag<std::uint16_t> d{};
    using V = hwy::HWY_NAMESPACE::Vec<hwy::HWY_NAMESPACE::ScalableTag<std::uint16_t>>;

public:
    explicit SupportLanes(const FlyingPixelRule& rule)
        : constant_(hwy::HWY_NAMESPACE::Set(d, rule.tolerance.constant)),
          slope_(hwy::HWY_NAMESPACE::Set(d, rule.tolerance.slope)),
          most_lonely_(hwy::HWY_NAMESPACE::Set(d, std::uint16_t(8 - rule.min_support))) {}

    // `pixel` points into a plane.
    HWY_INLINE V operator()(const std::uint16_t* pixel, std::ptrdiff_t pitch) const {
        namespace hn = hwy::HWY_NAMESPACE;
        const auto one = hn::Set(d, 1);
        const auto center = hn::LoadU(d, pixel);
        const auto tolerance = hn::Min(hn::SaturatedAdd(constant_, hn::MulHigh(center, slope_)),
                                       hn::SaturatedSub(center, one));
        const auto nearest = hn::Sub(center, tolerance);
        // Nearer neighbours wrap around to large numbers, beyond the width.
        const auto width = hn::Sub(hn::SaturatedAdd(center, tolerance), nearest);
        const auto lonely = [&](std::ptrdiff_t beside) HWY_ATTR {
            const auto beyond =
                hn::SaturatedSub(hn::Sub(hn::LoadU(d, pixel + beside), nearest), width);
            return hn::Min(beyond, one);
        };
        const auto above = hn::Add(hn::Add(lonely(-pitch - 1), lonely(-pitch)), lonely(-pitch + 1));
        const auto below = hn::Add(hn::Add(lonely(pitch - 1), lonely(pitch)), lonely(pitch + 1));
        const auto count = hn::Add(hn::Add(above, below), hn::Add(lonely(-1), lonely(1)));
        return hn::IfThenZeroElse(hn::Gt(count, most_lonely_), center);
    }

private:
    V constant_, slope_, most_lonely_;
};

}  // namespace theatron::filter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
