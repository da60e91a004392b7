// SPDX-License-Identifier: Apache-2.0
#include "filter/kalman.h"

#include <cassert>
#include <cstring>

// Compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/kalman.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "filter/support_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::filter::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// kalman_step() for a vector of pixels; the names are the same.
class KalmanLanes {
public:
    KalmanLanes(const KalmanRule& rule, int boost)
        : noise_constant_(hn::Set(du, std::uint16_t(rule.noise_constant))),
          noise_squared_(hn::Set(du, std::uint16_t(rule.noise_squared))),
          reset_sigmas_(hn::Set(di, std::int16_t(rule.reset_sigmas << 10))),
          trend_(hn::Set(du, std::uint16_t(rule.trend))),
          least_gain_(hn::Set(di, std::int16_t(rule.least_gain))),
          gain_at_rest_(hn::Set(di, std::int16_t(larger(rule.least_gain, gain_at_rest)))),
          // With a boost no gain is at rest.
          gains_at_rest_(hn::Set(
              du, std::uint16_t(boost > 0 ? 0xffff : larger(rule.least_gain, gain_at_rest)))),
          twice_least_gain_(hn::Set(du, std::uint16_t(2 * rule.least_gain))),
          most_hold_(hn::Set(du, std::uint16_t(rule.most_hold << 12))),
          fresh_gain_(hn::Set(
              du,
              std::uint16_t(gain_after_reset | (smaller(hold_after_reset, rule.most_hold) << 12)))),
          boost_(hn::Set(di, std::int16_t(smaller(boost, 255)))) {
        for (int times = 1; times <= trend_steps; ++times)
            floor_[times - 1] =
                hn::Set(di, std::int16_t(larger(rule.least_gain, trend_gain(times))));
    }

    // Advances the state of the pixels at these places, and returns their depth.
    HWY_INLINE auto step(hn::Vec<hn::ScalableTag<std::uint16_t>> measured, std::uint16_t* depth_at,
                         std::uint16_t* estimate_at, std::uint16_t* gain_at) const {
        const auto depth = hn::LoadU(du, depth_at);
        const auto zero = hn::Zero(du);
        // The sensor's blind corners, and where the background is gone.
        if (hn::AllTrue(du, hn::Eq(hn::Or(measured, depth), zero)))
            return zero;
        const auto estimate = hn::LoadU(du, estimate_at);
        const auto gains = hn::LoadU(du, gain_at);

        const auto squared = hn::MulHigh(depth, depth);
        const auto noise =
            hn::Min(hn::SaturatedAdd(noise_constant_, hn::MulHigh(squared, noise_squared_)),
                    hn::Set(du, most_noise));
        const auto noise_i = hn::BitCast(di, noise);
        // (reset_sigmas * noise + 16) >> 5
        const auto reset = hn::BitCast(du, hn::MulFixedPoint15(noise_i, reset_sigmas_));
        const auto distance =
            hn::Or(hn::SaturatedSub(measured, depth), hn::SaturatedSub(depth, measured));
        const auto jump = hn::Gt(distance, reset);

        // From here on for a measured pixel that is no jump; what becomes of others is
        // thrown away. Shifts with rounding are multiplications.
        const auto rest = hn::ShiftRight<8>(hn::BitCast(di, estimate));
        const auto innovation =
            hn::Sub(hn::BitCast(di, hn::ShiftLeft<estimate_bits>(hn::Sub(measured, depth))), rest);
        auto trend = hn::Add(
            hn::MulFixedPoint15(hn::BitCast(di, hn::ShiftLeft<8>(estimate)), hn::Set(di, 7 << 4)),
            hn::MulFixedPoint15(innovation, hn::Set(di, 1 << 11)));
        trend = hn::Min(hn::Max(trend, hn::Set(di, -127)), hn::Set(di, 127));
        const auto size = hn::Abs(trend);
        const auto threshold = hn::BitCast(di, hn::MulHigh(hn::ShiftLeft<3>(noise), trend_));
        const auto moving = hn::Gt(size, threshold);
        const auto dead_band =
            hn::ShiftRight<2>(hn::Max(noise_i, hn::Set(di, least_dead_band_noise)));

        // Most pixels have long been still: their gains stay as they are.
        const auto is_measured = hn::Ne(measured, zero);
        const auto restless = hn::Or(jump, hn::RebindMask(du, moving));
        const auto at_rest = hn::Eq(hn::And(gains, hn::Set(du, 0x0fff)), gains_at_rest_);
        if (hn::AllTrue(du, hn::AndNot(restless, hn::And(is_measured, at_rest)))) {
            const Followed pixel =
                followed(depth, rest, innovation, trend, gain_at_rest_, dead_band);
            hn::StoreU(pixel.depth, du, depth_at);
            hn::StoreU(pixel.estimate, du, estimate_at);
            return pixel.depth;
        }

        const auto old_gain = hn::And(gains, hn::Set(du, 0xff));
        auto floor = hn::IfThenElse(moving, floor_[0], least_gain_);
        auto beyond = threshold;
        for (int times = 2; times <= trend_steps; ++times) {
            beyond = hn::Add(beyond, threshold);
            floor = hn::IfThenElse(hn::Gt(size, beyond), floor_[times - 1], floor);
        }
        const auto gain =
            hn::Max(hn::Min(hn::Add(hn::BitCast(di, old_gain), boost_), hn::Set(di, 255)), floor);
        const Followed pixel =
            followed(depth, rest, innovation, trend, gain,
                     hn::IfThenElse(moving, hn::Set(di, moving_dead_band), dead_band));
        const auto gain_u = hn::BitCast(du, gain);
        const auto next_gain = hn::Max(hn::Sub(gain_u, hn::ShiftRight<9>(hn::Mul(gain_u, gain_u))),
                                       hn::BitCast(du, least_gain_));

        // Numbers of frames stay where they are: in the highest bits.
        const auto missing = hn::And(hn::ShiftLeft<4>(gains), hn::Set(du, 0xf000));
        const auto hold = hn::And(gains, hn::Set(du, 0xf000));
        const auto longer =
            hn::Min(hn::Max(hold, hn::SaturatedAdd(missing, hn::Set(du, 0x2000))), most_hold_);
        const auto grows = hn::AndNot(hn::Gt(old_gain, twice_least_gain_), hn::Ne(missing, zero));
        const auto next_hold = hn::IfThenElse(grows, longer, hold);

        // One of four: followed, begun anew, held, gone. What was not known has no hold.
        const auto follows = hn::AndNot(jump, hn::Ne(hn::Min(measured, depth), zero));
        const auto held = hn::AndNot(is_measured, hn::Lt(missing, hold));
        const auto next_depth =
            hn::IfThenElse(held, depth, hn::IfThenElse(follows, pixel.depth, measured));
        hn::StoreU(next_depth, du, depth_at);
        hn::StoreU(hn::IfThenElse(held, estimate, hn::IfThenElseZero(follows, pixel.estimate)), du,
                   estimate_at);
        const auto measured_gain = hn::IfThenElse(follows, hn::Or(next_gain, next_hold),
                                                  hn::IfThenElseZero(is_measured, fresh_gain_));
        hn::StoreU(hn::IfThenElse(held, hn::Add(gains, hn::Set(du, 1 << 8)), measured_gain), du,
                   gain_at);
        return next_depth;
    }

private:
    using DU = hn::ScalableTag<std::uint16_t>;
    using DI = hn::ScalableTag<std::int16_t>;
    static constexpr DU du{};
    static constexpr DI di{};
    using VU = hn::Vec<DU>;
    using VI = hn::Vec<DI>;

    struct Followed {
        VU depth, estimate;
    };
    static HWY_INLINE Followed followed(VU depth, VI rest, VI innovation, VI trend, VI gain,
                                        VI dead_band) {
        // (innovation * gain + 128) >> 8
        const auto moved = hn::Add(rest, hn::MulFixedPoint15(innovation, hn::ShiftLeft<7>(gain)));
        // (moved + 16) >> 5
        const auto step = hn::IfThenElseZero(hn::Gt(hn::Abs(moved), dead_band),
                                             hn::MulFixedPoint15(moved, hn::Set(di, 1 << 10)));
        const auto left = hn::Sub(moved, hn::ShiftLeft<estimate_bits>(step));
        // Less half the range, to add signed numbers with saturation.
        const auto half = hn::Set(du, 0x8000);
        const auto next = hn::Max(hn::SaturatedAdd(hn::BitCast(di, hn::Xor(depth, half)), step),
                                  hn::Set(di, -0x7fff));
        return {hn::Xor(hn::BitCast(du, next), half),
                hn::Or(hn::BitCast(du, hn::ShiftLeft<8>(left)),
                       hn::And(hn::BitCast(du, trend), hn::Set(du, 0xff)))};
    }

    VU noise_constant_, noise_squared_;
    VI reset_sigmas_;
    VU trend_;
    VI least_gain_, gain_at_rest_;
    VU gains_at_rest_, twice_least_gain_, most_hold_, fresh_gain_;
    VI boost_;
    VI floor_[trend_steps];
};

class KalmanRows {
public:
    KalmanRows(const KalmanRule& rule, int boost, KalmanState& state, MutableDepthView out)
        : kalman_(rule, boost), state_(state), out_(out) {}

    // `measured`: the row, readable to the end of the last vector.
    HWY_INLINE void step(const std::uint16_t* measured, int y) const {
        const hn::ScalableTag<std::uint16_t> d;
        const int lanes = int(hn::Lanes(d)), width = out_.size.width;
        std::uint16_t* depth = state_.depth.row(y);
        std::uint16_t* estimate = state_.estimate.row(y);
        std::uint16_t* gain = state_.gain.row(y);
        std::uint16_t* out = out_.row(y);
        int x = 0;
        for (; x + lanes <= width; x += lanes)
            hn::StoreU(kalman_.step(hn::LoadU(d, measured + x), depth + x, estimate + x, gain + x),
                       d, out + x);
        if (x < width) {
            kalman_.step(hn::LoadU(d, measured + x), depth + x, estimate + x, gain + x);
            std::memcpy(out + x, depth + x, std::size_t(width - x) * sizeof(*depth));
        }
    }

private:
    KalmanLanes kalman_;
    KalmanState& state_;
    MutableDepthView out_;
};

void kalman_rows(const DepthPlane& in, const KalmanRule& rule, int boost, KalmanState& state,
                 MutableDepthView out) {
    const KalmanRows rows(rule, boost, state, out);
    for (int y = 0; y < in.size().height; ++y)
        rows.step(in.row(y), y);
}

void supported_kalman_rows(const DepthPlane& in, const FlyingPixelRule& flying,
                           const KalmanRule& rule, int boost, KalmanState& state,
                           MutableDepthView out) {
    const hn::ScalableTag<std::uint16_t> d;
    const KalmanRows rows(rule, boost, state, out);
    const SupportLanes supported(flying);
    for (int y = 0; y < in.size().height; ++y) {
        std::uint16_t* row = state.row.row(0);
        for (int x = 0; x < in.padded_width(); x += int(hn::Lanes(d)))
            hn::StoreU(supported(in.row(y) + x, in.pitch()), d, row + x);
        rows.step(row, y);
    }
}

}  // namespace theatron::filter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace theatron::filter {

HWY_EXPORT(kalman_rows);
HWY_EXPORT(supported_kalman_rows);

void apply_kalman(const DepthPlane& in, const KalmanRule& rule, int boost, KalmanState& state,
                  MutableDepthView out) {
    assert(in.size() == out.size && in.size() == state.depth.size());
    HWY_DYNAMIC_DISPATCH(kalman_rows)(in, rule, boost, state, out);
}

void apply_kalman_to_supported(const DepthPlane& in, const FlyingPixelRule& flying,
                               const KalmanRule& rule, int boost, KalmanState& state,
                               MutableDepthView out) {
    assert(in.size() == out.size && in.size() == state.depth.size());
    HWY_DYNAMIC_DISPATCH(supported_kalman_rows)(in, flying, rule, boost, state, out);
}

}  // namespace theatron::filter
#endif
