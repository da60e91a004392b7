// SPDX-License-Identifier: Apache-2.0
#include "filter/kalman.h"

#include <cassert>

#include "image/scratch.h"

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/kalman.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "filter/support_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::filter::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// kalman_step() for vectors of pixels, with the same names. Vectors whose pixels have all
// been static for long take a shorter path.
class KalmanLanes {
public:
    KalmanLanes(const KalmanRule& rule, int boost)
        : keeps_rest_(boost == 0),
          noise_constant_(u(rule.noise_constant)),
          noise_squared_(u(rule.noise_squared)),
          most_noise_(u(most_noise)),
          least_dead_band_noise_(i(least_dead_band_noise)),
          moving_dead_band_(i(moving_dead_band)),
          reset_sigmas_(i(rule.reset_sigmas << 10)),
          trend_(u(rule.trend)),
          trend_at_rest_(u(smaller(8 * rule.trend, most_trend_at_rest))),
          old_trend_share_(i(7 << 4)),
          new_trend_share_(i(1 << 11)),
          most_trend_(i(127)),
          least_trend_(i(-127)),
          least_gain_(i(rule.least_gain)),
          most_gain_(i(255)),
          shifted_gain_at_rest_(i(larger(rule.least_gain, gain_at_rest) << 7)),
          // With a boost, no gain counts as being at rest.
          gains_at_rest_(u(boost > 0 ? 0xffff : larger(rule.least_gain, gain_at_rest))),
          twice_least_gain_(u(2 * rule.least_gain)),
          most_hold_(u(rule.most_hold << 12)),
          fresh_gain_(u(gain_after_reset | (smaller(hold_after_reset, rule.most_hold) << 12))),
          boost_(i(smaller(boost, 255))),
          unit_(i(1 << 10)),
          least_usual_depth_(i(3)),
          low_byte_(u(0xff)),
          hold_bits_(u(0xf000)),
          missing_bits_(u(0x0f00)),
          one_missing_(u(0x0100)),
          two_to_hold_(u(0x2000)),
          half_range_(u(0x8000)),
          least_signed_(i(-0x7fff)) {
        for (int times = 1; times <= trend_steps; ++times)
            floor_[times - 1] = i(larger(rule.least_gain, trend_gain(times)));
    }

    // Advances the state of row `y`. `measured` is readable up to the row's padded width.
    // Not inlined: compilers would otherwise recompute the constants for each vector, which
    // doubles the time.
    HWY_NOINLINE void step(const std::uint16_t* measured, KalmanState& state, int y) const {
        std::uint16_t* depth = state.depth.row(y);
        std::uint16_t* estimate = state.estimate.row(y);
        std::uint16_t* gain = state.gain.row(y);
        std::uint8_t* at_rest = state.at_rest_row(y);
        const int width = state.depth.padded_width();
        for (int x = 0; x < width; ++at_rest) {
            const bool was_at_rest = *at_rest != 0 && keeps_rest_;
            bool all_at_rest = true;
            for (const int end = x + KalmanState::block; x < end; x += int(hn::Lanes(du)))
                all_at_rest &= step(hn::LoadU(du, measured + x), depth + x, estimate + x, gain + x,
                                    was_at_rest);
            *at_rest = all_at_rest;
        }
    }

private:
    using DU = hn::ScalableTag<std::uint16_t>;
    using DI = hn::ScalableTag<std::int16_t>;
    static constexpr DU du{};
    static constexpr DI di{};
    using VU = hn::Vec<DU>;
    using VI = hn::Vec<DI>;
    static VU u(int value) { return hn::Set(du, std::uint16_t(value)); }
    static VI i(int value) { return hn::Set(di, std::int16_t(value)); }
    // Keeps the threshold at most at that of the largest trend, 127.
    static constexpr int most_trend_at_rest = (128 << 16) / most_noise - 1;

    // True if all gains are at rest afterwards. With `were_at_rest` gains are not loaded.
    HWY_INLINE bool step(VU measured, std::uint16_t* depth_at, std::uint16_t* estimate_at,
                         std::uint16_t* gain_at, bool were_at_rest) const {
        const auto depth = hn::LoadU(du, depth_at);
        // Empty vectors: the sensor's blind corners, and removed background.
        const auto absent = hn::Eq(hn::Or(measured, depth), hn::Zero(du));
        if (hn::AllTrue(du, absent))
            return true;
        const auto estimate = hn::LoadU(du, estimate_at);

        const auto squared = hn::MulHigh(depth, depth);
        const auto noise = hn::Min(
            hn::SaturatedAdd(noise_constant_, hn::MulHigh(squared, noise_squared_)), most_noise_);
        const auto noise_i = hn::BitCast(di, noise);
        // (reset_sigmas * noise + 16) >> 5. Rounding shifts are done by multiplications.
        const auto reset = hn::MulFixedPoint15(noise_i, reset_sigmas_);
        const auto difference = hn::BitCast(di, hn::Sub(measured, depth));
        // From here on, values are valid for measured pixels that do not jump. Those of
        // other pixels are not used.
        const auto rest = hn::ShiftRight<8>(hn::BitCast(di, estimate));
        const auto innovation = hn::Sub(hn::ShiftLeft<estimate_bits>(difference), rest);
        const auto trend = hn::Add(
            hn::MulFixedPoint15(hn::BitCast(di, hn::ShiftLeft<8>(estimate)), old_trend_share_),
            hn::MulFixedPoint15(innovation, new_trend_share_));
        const auto dead_band = hn::ShiftRight<2>(hn::Max(noise_i, least_dead_band_noise_));

        // The usual case: all pixels were measured before and now, and follow. Their depths
        // fit into 15 bits and are not too small. Absent pixels are 0 in all numbers and
        // remain so.
        const auto usual = hn::RebindMask(
            du,
            hn::Gt(hn::Min(hn::BitCast(di, measured), hn::BitCast(di, depth)), least_usual_depth_));
        const auto jumps = hn::RebindMask(du, hn::Gt(hn::Abs(difference), reset));
        const auto goes_on = hn::AndNot(jumps, hn::Or(usual, absent));
        const auto moves = hn::RebindMask(
            du, hn::Gt(hn::Abs(trend), hn::BitCast(di, hn::MulHigh(noise, trend_at_rest_))));
        const auto follow_at_rest = [&]() HWY_ATTR {
            const auto moved = moved_by(innovation, rest, shifted_gain_at_rest_);
            const auto step = step_of(moved, dead_band);
            hn::StoreU(hn::Add(depth, hn::BitCast(du, step)), du, depth_at);
            hn::StoreU(estimate_of(moved, step, trend), du, estimate_at);
        };
        if (were_at_rest && hn::AllTrue(du, hn::AndNot(moves, goes_on))) {
            follow_at_rest();
            return true;
        }

        const auto gains = hn::LoadU(du, gain_at);
        const auto was_there = hn::Eq(hn::And(gains, missing_bits_), hn::Zero(du));
        if (hn::AllTrue(du, hn::And(goes_on, was_there))) {
            const auto low_gain = hn::Eq(hn::And(gains, low_byte_), gains_at_rest_);
            if (hn::AllTrue(du, hn::AndNot(moves, hn::Or(low_gain, absent)))) {
                follow_at_rest();
                return true;
            }
            const Follow follow(*this, innovation, rest, trend, noise, gains, dead_band);
            const auto next_gains = hn::Or(follow.gain, hn::And(gains, hold_bits_));
            hn::StoreU(hn::Add(depth, hn::BitCast(du, follow.step)), du, depth_at);
            hn::StoreU(follow.estimate, du, estimate_at);
            hn::StoreU(hn::IfThenZeroElse(absent, next_gains), du, gain_at);
            return false;
        }

        const Follow follow(*this, innovation, rest, trend, noise, gains, dead_band);
        const auto zero = hn::Zero(du);
        // Frame counts are processed in place, in the highest bits.
        const auto missing = hn::And(hn::ShiftLeft<4>(gains), hold_bits_);
        const auto hold = hn::And(gains, hold_bits_);
        const auto longer =
            hn::Min(hn::Max(hold, hn::SaturatedAdd(missing, two_to_hold_)), most_hold_);
        const auto grows =
            hn::AndNot(hn::Gt(hn::And(gains, low_byte_), twice_least_gain_), hn::Ne(missing, zero));
        const auto next_hold = hn::IfThenElse(grows, longer, hold);

        // Each pixel is followed, reset, held or cleared. An unknown pixel has no hold.
        const auto is_measured = hn::Ne(measured, zero);
        const auto distance =
            hn::Or(hn::SaturatedSub(measured, depth), hn::SaturatedSub(depth, measured));
        const auto follows = hn::AndNot(hn::Gt(distance, hn::BitCast(du, reset)),
                                        hn::Ne(hn::Min(measured, depth), zero));
        const auto held = hn::AndNot(is_measured, hn::Lt(missing, hold));
        // Subtracts half the range, so that signed addition saturates.
        const auto stepped =
            hn::Max(hn::SaturatedAdd(hn::BitCast(di, hn::Xor(depth, half_range_)), follow.step),
                    least_signed_);
        const auto followed = hn::Xor(hn::BitCast(du, stepped), half_range_);
        hn::StoreU(hn::IfThenElse(held, depth, hn::IfThenElse(follows, followed, measured)), du,
                   depth_at);
        hn::StoreU(hn::IfThenElse(held, estimate, hn::IfThenElseZero(follows, follow.estimate)), du,
                   estimate_at);
        const auto measured_gain = hn::IfThenElse(follows, hn::Or(follow.gain, next_hold),
                                                  hn::IfThenElseZero(is_measured, fresh_gain_));
        hn::StoreU(hn::IfThenElse(held, hn::Add(gains, one_missing_), measured_gain), du, gain_at);
        return false;
    }

    // followed(), for any gain.
    struct Follow {
        HWY_INLINE Follow(const KalmanLanes& k, VI innovation, VI rest, VI any_trend, VU noise,
                          VU gains, VI still_dead_band) {
            const auto trend = hn::Min(hn::Max(any_trend, k.least_trend_), k.most_trend_);
            const auto size = hn::Abs(trend);
            const auto threshold = hn::BitCast(di, hn::MulHigh(hn::ShiftLeft<3>(noise), k.trend_));
            const auto moving = hn::Gt(size, threshold);
            auto floor = raised(k.least_gain_, moving, k.floor_[0]);
            auto beyond = threshold;
            for (int times = 2; times <= trend_steps; ++times) {
                beyond = hn::Add(beyond, threshold);
                floor = raised(floor, hn::Gt(size, beyond), k.floor_[times - 1]);
            }
            const auto old_gain = hn::BitCast(di, hn::And(gains, k.low_byte_));
            const auto new_gain =
                hn::Max(hn::Min(hn::Add(old_gain, k.boost_), k.most_gain_), floor);
            const auto shifted_gain = hn::ShiftLeft<7>(new_gain);
            const auto moved = moved_by(innovation, rest, shifted_gain);
            step = k.step_of(moved, lowered(still_dead_band, moving, k.moving_dead_band_));
            estimate = k.estimate_of(moved, step, trend);
            // gain * gain >> 9
            const auto fall = hn::MulHigh(hn::BitCast(du, shifted_gain), hn::BitCast(du, new_gain));
            gain =
                hn::BitCast(du, hn::Max(hn::Sub(new_gain, hn::BitCast(di, fall)), k.least_gain_));
        }
        VI step;
        VU estimate, gain;
    };

    // `to` where the mask is set, which is nowhere less (raised) or more (lowered) than `from`.
    // Both are positive. AVX2 chooses between two vectors slowly, AVX-512 does not.
#if HWY_TARGET <= HWY_AVX3
    static HWY_INLINE VI raised(VI from, hn::Mask<DI> mask, VI to) {
        return hn::IfThenElse(mask, to, from);
    }
    static HWY_INLINE VI lowered(VI from, hn::Mask<DI> mask, VI to) {
        return hn::IfThenElse(mask, to, from);
    }
#else
    static HWY_INLINE VI raised(VI from, hn::Mask<DI> mask, VI to) {
        return hn::Max(from, hn::IfThenElseZero(mask, to));
    }
    static HWY_INLINE VI lowered(VI from, hn::Mask<DI> mask, VI to) {
        return hn::Max(hn::IfThenZeroElse(mask, from), to);
    }
#endif

    // rest + ((innovation * gain + 128) >> 8)
    static HWY_INLINE VI moved_by(VI innovation, VI rest, VI shifted_gain) {
        return hn::Add(rest, hn::MulFixedPoint15(innovation, shifted_gain));
    }
    // (moved + 16) >> 5, or 0
    HWY_INLINE VI step_of(VI moved, VI dead_band) const {
        return hn::IfThenElseZero(hn::Gt(hn::Abs(moved), dead_band),
                                  hn::MulFixedPoint15(moved, unit_));
    }
    HWY_INLINE VU estimate_of(VI moved, VI step, VI trend) const {
        const auto left = hn::Sub(moved, hn::ShiftLeft<estimate_bits>(step));
        return hn::OrAnd(hn::BitCast(du, hn::ShiftLeft<8>(left)), hn::BitCast(du, trend),
                         low_byte_);
    }

    bool keeps_rest_;
    VU noise_constant_, noise_squared_, most_noise_;
    VI least_dead_band_noise_, moving_dead_band_;
    VI reset_sigmas_;
    VU trend_, trend_at_rest_;
    VI old_trend_share_, new_trend_share_, most_trend_, least_trend_;
    VI least_gain_, most_gain_, shifted_gain_at_rest_;
    VU gains_at_rest_, twice_least_gain_, most_hold_, fresh_gain_;
    VI boost_, unit_, least_usual_depth_;
    VU low_byte_, hold_bits_, missing_bits_, one_missing_, two_to_hold_;
    VU half_range_;
    VI least_signed_;
    VI floor_[trend_steps];
};

void kalman_rows(const DepthPlane& in, const KalmanRule& rule, int boost, KalmanState& state) {
    const KalmanLanes kalman(rule, boost);
    for (int y = 0; y < in.size().height; ++y)
        kalman.step(in.row(y), state, y);
}

void supported_kalman_rows(const DepthPlane& in, const FlyingPixelRule& flying,
                           const KalmanRule& rule, int boost, KalmanState& state, DepthPlane& row) {
    const hn::ScalableTag<std::uint16_t> d;
    const KalmanLanes kalman(rule, boost);
    const SupportLanes supported(flying);
    for (int y = 0; y < in.size().height; ++y) {
        std::uint16_t* measured = row.row(0);
        for (int x = 0; x < in.padded_width(); x += int(hn::Lanes(d)))
            hn::StoreU(supported(in.row(y) + x, in.pitch()), d, measured + x);
        kalman.step(measured, state, y);
    }
}

}  // namespace theatron::filter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace theatron::filter {

HWY_EXPORT(kalman_rows);
HWY_EXPORT(supported_kalman_rows);

void apply_kalman(const DepthPlane& in, const KalmanRule& rule, int boost, KalmanState& state) {
    assert(in.size() == state.depth.size());
    HWY_DYNAMIC_DISPATCH(kalman_rows)(in, rule, boost, state);
}

void apply_kalman_to_supported(const DepthPlane& in, const FlyingPixelRule& flying,
                               const KalmanRule& rule, int boost, KalmanState& state) {
    assert(in.size() == state.depth.size());
    auto& row = scratch_of_this_thread<DepthPlane>({in.size().width, 1});
    HWY_DYNAMIC_DISPATCH(supported_kalman_rows)(in, flying, rule, boost, state, row);
}

}  // namespace theatron::filter
#endif
