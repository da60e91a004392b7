// SPDX-License-Identifier: Apache-2.0
#include "filter/kalman.h"

#include <cassert>
#include <cstring>

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/kalman.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::filter::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// kalman_step() for a vector of pixels; the names are the same.
class KalmanLanes {
public:
    KalmanLanes(const KalmanRule& rule, int boost)
        : noise_constant_(hn::Set(du, std::uint16_t(rule.noise_constant))),
          noise_squared_(hn::Set(du, std::uint16_t(rule.noise_squared))),
          reset_sigmas_(hn::Set(di, std::int16_t(rule.reset_sigmas))),
          trend_(hn::Set(du, std::uint16_t(rule.trend))),
          least_gain_(hn::Set(di, std::int16_t(rule.least_gain))),
          twice_least_gain_(hn::Set(du, std::uint16_t(2 * rule.least_gain))),
          most_hold_(hn::Set(du, std::uint16_t(rule.most_hold))),
          fresh_gain_(hn::Set(
              du,
              std::uint16_t(gain_after_reset | (smaller(hold_after_reset, rule.most_hold) << 12)))),
          boost_(hn::Set(di, std::int16_t(smaller(boost, 255)))) {}

    // Advances the state of the pixels at these places, and returns their depth.
    HWY_INLINE auto step(const std::uint16_t* in, std::uint16_t* depth_at,
                         std::uint16_t* estimate_at, std::uint16_t* gain_at) const {
        const auto measured = hn::LoadU(du, in);
        const auto depth = hn::LoadU(du, depth_at);
        const auto zero = hn::Zero(du);
        // The sensor's blind corners, and where the background is gone.
        if (hn::AllTrue(du, hn::Eq(hn::Or(measured, depth), zero)))
            return zero;
        const auto estimate = hn::LoadU(du, estimate_at);
        const auto gains = hn::LoadU(du, gain_at);

        const auto missing = hn::And(hn::ShiftRight<8>(gains), hn::Set(du, 0xf));
        const auto hold = hn::ShiftRight<12>(gains);
        const auto is_measured = hn::Ne(measured, zero);
        const auto known = hn::Ne(depth, zero);

        const auto squared = hn::MulHigh(depth, depth);
        const auto noise =
            hn::Min(hn::SaturatedAdd(noise_constant_, hn::MulHigh(squared, noise_squared_)),
                    hn::Set(du, most_noise));
        const auto rest = signed_(hn::ShiftRight<8>(estimate), 128);
        const auto far = hn::Set(du, 1000);
        const auto ahead = as_signed(hn::Min(hn::SaturatedSub(measured, depth), far));
        const auto behind = as_signed(hn::Min(hn::SaturatedSub(depth, measured), far));
        const auto innovation = hn::Sub(hn::ShiftLeft<estimate_bits>(hn::Sub(ahead, behind)), rest);
        const auto noise_i = as_signed(noise);
        const auto jump = hn::Gt(hn::Abs(innovation), hn::Mul(reset_sigmas_, noise_i));

        // A measured pixel that is no jump.
        auto trend = signed_(hn::And(estimate, hn::Set(du, 0xff)), 128);
        trend = hn::Sub(trend, hn::ShiftRight<3>(hn::Add(trend, hn::Set(di, 4))));
        trend = hn::Add(trend, hn::ShiftRight<4>(hn::Add(innovation, hn::Set(di, 8))));
        trend = clamp(trend, -127, 127);
        const auto mean = hn::Add(hn::Abs(trend), hn::Abs(trend));
        const auto threshold =
            as_signed(hn::Min(hn::MulHigh(hn::ShiftLeft<4>(noise), trend_), hn::Set(du, 4095)));
        auto floor = least_gain_;
        auto beyond = threshold;
        for (int times = 1; times <= trend_steps; ++times) {
            const auto raised = hn::Max(floor, hn::Set(di, std::int16_t(trend_gain(times))));
            floor = hn::IfThenElse(hn::Gt(mean, beyond), raised, floor);
            beyond = hn::Add(beyond, threshold);
        }
        const auto moving = hn::Gt(mean, threshold);
        const auto old_gain = hn::And(gains, hn::Set(du, 0xff));
        auto gain = hn::Add(as_signed(old_gain), boost_);
        gain = hn::Max(hn::Min(gain, hn::Set(di, 255)), floor);

        // (innovation * gain + 128) >> 8
        const auto moved = hn::Add(rest, hn::MulFixedPoint15(innovation, hn::ShiftLeft<7>(gain)));
        const auto dead_band =
            hn::IfThenElse(moving, hn::Set(di, 16),
                           clamp(hn::ShiftRight<2>(noise_i), least_dead_band, most_dead_band));
        const auto step =
            hn::IfThenElseZero(hn::Gt(hn::Abs(moved), dead_band),
                               hn::ShiftRight<estimate_bits>(hn::Add(moved, hn::Set(di, 16))));
        const auto left = clamp(hn::Sub(moved, hn::ShiftLeft<estimate_bits>(step)), -most_estimate,
                                most_estimate);
        const auto nothing = hn::Zero(di);
        const auto up = hn::BitCast(du, hn::Max(step, nothing));
        const auto down = hn::BitCast(du, hn::Max(hn::Neg(step), nothing));
        const auto one = hn::Set(du, 1);
        const auto raised = hn::SaturatedAdd(depth, up);
        const auto followed = hn::Sub(raised, hn::Min(down, hn::Sub(raised, one)));

        const auto longer = hn::Min(hn::Max(hold, hn::Add(missing, hn::Set(du, 2))), most_hold_);
        const auto settled = hn::Not(hn::Gt(old_gain, twice_least_gain_));
        const auto grows = hn::And(hn::Ne(missing, zero), settled);
        const auto next_hold = hn::IfThenElse(grows, longer, hold);
        const auto gain_u = hn::BitCast(du, gain);
        const auto next_gain = hn::Max(hn::Sub(gain_u, hn::ShiftRight<9>(hn::Mul(gain_u, gain_u))),
                                       hn::BitCast(du, least_gain_));
        const auto middle = hn::Set(di, 128);
        const auto packed = hn::Or(hn::ShiftLeft<8>(hn::BitCast(du, hn::Add(left, middle))),
                                   hn::BitCast(du, hn::Add(trend, middle)));

        // One of four: followed, begun anew, held, gone.
        const auto follows = hn::AndNot(jump_mask(jump), known);
        auto next_depth = hn::IfThenElse(follows, followed, measured);
        auto next_estimate = hn::IfThenElse(follows, packed, hn::Set(du, 0x8080));
        auto next_gains =
            hn::IfThenElse(follows, hn::Or(next_gain, hn::ShiftLeft<12>(next_hold)), fresh_gain_);
        const auto held = hn::And(known, hn::Lt(missing, hold));
        next_depth = hn::IfThenElse(is_measured, next_depth, hn::IfThenElseZero(held, depth));
        next_estimate =
            hn::IfThenElse(is_measured, next_estimate, hn::IfThenElseZero(held, estimate));
        next_gains = hn::IfThenElse(is_measured, next_gains,
                                    hn::IfThenElseZero(held, hn::Add(gains, hn::Set(du, 1 << 8))));
        hn::StoreU(next_depth, du, depth_at);
        hn::StoreU(next_estimate, du, estimate_at);
        hn::StoreU(next_gains, du, gain_at);
        return next_depth;
    }

private:
    using DU = hn::ScalableTag<std::uint16_t>;
    using DI = hn::ScalableTag<std::int16_t>;
    static constexpr DU du{};
    static constexpr DI di{};
    using VU = hn::Vec<DU>;
    using VI = hn::Vec<DI>;

    static HWY_INLINE VI as_signed(VU v) { return hn::BitCast(di, v); }
    static HWY_INLINE VI signed_(VU v, int middle) {
        return hn::Sub(as_signed(v), hn::Set(di, std::int16_t(middle)));
    }
    static HWY_INLINE VI clamp(VI v, int low, int high) {
        return hn::Min(hn::Max(v, hn::Set(di, std::int16_t(low))), hn::Set(di, std::int16_t(high)));
    }
    static HWY_INLINE hn::Mask<DU> jump_mask(hn::Mask<DI> m) { return hn::RebindMask(du, m); }

    VU noise_constant_, noise_squared_;
    VI reset_sigmas_;
    VU trend_;
    VI least_gain_;
    VU twice_least_gain_, most_hold_, fresh_gain_;
    VI boost_;
};

void kalman_rows(const DepthPlane& in, const KalmanRule& rule, int boost, KalmanState& state,
                 MutableDepthView out) {
    const hn::ScalableTag<std::uint16_t> d;
    const int lanes = int(hn::Lanes(d));
    const KalmanLanes kalman(rule, boost);
    const auto [width, height] = in.size();
    for (int y = 0; y < height; ++y) {
        const std::uint16_t* row = in.row(y);
        std::uint16_t* depth = state.depth.row(y);
        std::uint16_t* estimate = state.estimate.row(y);
        std::uint16_t* gain = state.gain.row(y);
        std::uint16_t* out_row = out.row(y);
        int x = 0;
        for (; x + lanes <= width; x += lanes)
            hn::StoreU(kalman.step(row + x, depth + x, estimate + x, gain + x), d, out_row + x);
        if (x < width) {
            kalman.step(row + x, depth + x, estimate + x, gain + x);
            std::memcpy(out_row + x, depth + x, std::size_t(width - x) * sizeof(*depth));
        }
    }
}

}  // namespace theatron::filter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace theatron::filter {

HWY_EXPORT(kalman_rows);

void apply_kalman(const DepthPlane& in, const KalmanRule& rule, int boost, KalmanState& state,
                  MutableDepthView out) {
    assert(in.size() == out.size && in.size() == state.depth.size());
    HWY_DYNAMIC_DISPATCH(kalman_rows)(in, rule, boost, state, out);
}

}  // namespace theatron::filter
#endif
