// SPDX-License-Identifier: Apache-2.0
// Averages each pixel over time where nothing moves: one Kalman filter per pixel, adapted to
// depth images.
//
// Measurement noise grows with the distance. The gain is one half after a reset and falls
// towards that of a static pixel, as the filter's uncertainty would. Process noise depends
// on the measurements:
// - a measurement far from the estimate is motion: the pixel is reset to it;
// - measurements that stay on one side of the estimate are slow motion: the gain rises with
//   the duration and the distance, so that the estimate follows closely;
// - all else is noise. The output changes only when the estimate differs from it by more
//   than a part of the noise, so that static surfaces have constant depth.
// A pixel without measurement keeps its depth for one frame. It does so for longer if it
// disappeared and returned at the same distance before, as pixels at the limits of the
// sensor's range do.
//
// All numbers are 16-bit integers, so that all variants give equal results.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "filter/depth_plane.h"
#include "filter/flying_pixels.h"
#include "filter/rules.h"

namespace theatron::filter {

// The estimate is stored in units of 1/32 of a depth unit.
inline constexpr int estimate_bits = 5;

struct KalmanRule {
    int noise_constant = 16;    // in 1/32 unit
    int noise_squared = 34000;  // times depth^2 / 2^32, in 1/32 unit; at most 0xffff
    int reset_sigmas = 5;       // at most 20
    int trend = 2048;           // in 1/4096 sigma, of the mean of the innovations
    int least_gain = 20;        // of 256
    int most_hold = 8;          // frames, at most 15
};

// The state of a pixel, packed into three numbers.
struct KalmanPixel {
    std::uint16_t depth = 0;     // the output
    std::uint16_t estimate = 0;  // minus depth, in 1/32 (high byte); trend (low byte); both signed
    std::uint16_t gain = 0;      // of 256 (low byte); frames missing, frames to hold (4 bits each)
};

class KalmanState {
public:
    explicit KalmanState(Size size)
        : depth(size),
          estimate(size),
          gain(size),
          at_rest_(std::size_t(depth.padded_width() / block) * std::size_t(size.height)) {}
    void clear() {
        depth.clear();
        estimate.clear();
        gain.clear();
        std::fill(at_rest_.begin(), at_rest_.end(), std::uint8_t(0));
    }
    DepthPlane depth, estimate, gain;

    // One flag per block of pixels of a row: all gains are known to have reached their
    // minimum and need not be loaded. Only apply_kalman() maintains it: do not mix it with
    // the reference on one state.
    static constexpr int block = DepthPlane::margin;
    std::uint8_t* at_rest_row(int y) {
        return at_rest_.data() + std::ptrdiff_t(y) * (depth.padded_width() / block);
    }

private:
    std::vector<std::uint8_t> at_rest_;
};

// Filters one frame; the result is the state's depth. `boost` is added to all gains, for
// frames that were missed.
void apply_kalman(const DepthPlane& in, const KalmanRule& rule, int boost, KalmanState& state);
void apply_kalman_reference(const DepthPlane& in, const KalmanRule& rule, int boost,
                            KalmanState& state);

// Equals remove_flying_pixels() followed by apply_kalman(), in one pass.
void apply_kalman_to_supported(const DepthPlane& in, const FlyingPixelRule& flying,
                               const KalmanRule& rule, int boost, KalmanState& state);

inline constexpr int most_noise = 448;        // in 1/32 unit
inline constexpr int gain_after_reset = 128;  // of 256
inline constexpr int hold_after_reset = 1;
// The minimum gain, of 256, if the mean innovation exceeds 1, 2, 3 or 4 times the trend.
THEATRON_HD constexpr int trend_gain(int times) {
    return times == 1 ? 40 : times == 2 ? 90 : times == 3 ? 160 : 230;
}
inline constexpr int trend_steps = 4;
// Gains fall to this value, or to the rule's minimum: its square divided by 512 is 0.
inline constexpr int gain_at_rest = 22;
// The dead band is a share of the noise, where the noise counts at least this, in 1/32 unit.
inline constexpr int least_dead_band_noise = 96;
inline constexpr int dead_band_share = 4;
inline constexpr int moving_dead_band = 16;

THEATRON_HD inline int noise_at(const KalmanRule& rule, int depth) {
    const int squared = (depth * std::int64_t(depth)) >> 16;
    return smaller(rule.noise_constant + int((std::int64_t(squared) * rule.noise_squared) >> 16),
                   most_noise);
}

// The update of a measured pixel that does not jump.
THEATRON_HD inline KalmanPixel followed(const KalmanPixel& before, int difference, int noise,
                                        const KalmanRule& rule, int boost) {
    const int rest = std::int8_t(before.estimate >> 8);
    int trend = std::int8_t(before.estimate & 0xff);
    int gain = smaller((before.gain & 0xff) + boost, 255);
    const int missing = (before.gain >> 8) & 0xf;
    int hold = before.gain >> 12;

    // A leaky sum of innovations, in half units: 8 times their recent mean.
    const int innovation = difference * (1 << estimate_bits) - rest;
    trend = clamped(((7 * trend + 4) >> 3) + ((innovation + 8) >> 4), -127, 127);
    const int size = trend < 0 ? -trend : trend;
    const int threshold = ((noise << 3) * rule.trend) >> 16;
    int floor = rule.least_gain;
    for (int times = 1; times <= trend_steps; ++times)
        if (size > times * threshold)
            floor = larger(floor, trend_gain(times));
    const bool moving = size > threshold;
    gain = larger(gain, floor);

    const int moved = rest + ((innovation * gain + 128) >> 8);
    const int dead_band =
        moving ? moving_dead_band : larger(noise, least_dead_band_noise) / dead_band_share;
    const int step = (moved < 0 ? -moved : moved) > dead_band ? (moved + 16) >> estimate_bits : 0;
    const int left = moved - step * (1 << estimate_bits);  // at most the dead band, fits a byte

    // Only pixels that were static for long may be missing for long.
    if (missing > 0 && (before.gain & 0xff) <= 2 * rule.least_gain)
        hold = smaller(larger(hold, missing + 2), rule.most_hold);
    const int next_gain = larger(gain - ((gain * gain) >> 9), rule.least_gain);

    KalmanPixel after;
    after.depth = std::uint16_t(clamped(before.depth + step, 1, 0xffff));
    after.estimate = std::uint16_t(left * 256 + (trend & 0xff));
    after.gain = std::uint16_t(next_gain | (hold << 12));
    return after;
}

THEATRON_HD inline KalmanPixel kalman_step(const KalmanPixel& before, int measured,
                                           const KalmanRule& rule, int boost) {
    if (measured == none) {
        const int missing = (before.gain >> 8) & 0xf, hold = before.gain >> 12;
        if (before.depth == none || missing >= hold)
            return {};
        KalmanPixel held = before;
        held.gain = std::uint16_t(before.gain + (1 << 8));
        return held;
    }
    const int noise = noise_at(rule, before.depth);
    const int reset = (rule.reset_sigmas * noise + 16) >> estimate_bits;
    if (before.depth == none || distance(measured, before.depth) > reset) {
        KalmanPixel fresh;
        fresh.depth = std::uint16_t(measured);
        fresh.gain =
            std::uint16_t(gain_after_reset | (smaller(hold_after_reset, rule.most_hold) << 12));
        return fresh;
    }
    return followed(before, measured - before.depth, noise, rule, boost);
}

}  // namespace theatron::filter
