// SPDX-License-Identifier: Apache-2.0
// Averages each pixel over time where nothing moves: a Kalman filter per pixel,
// adapted to depth images.
//
// Measurement noise grows with the distance. The gain starts at one half after a
// change and falls towards that of a still pixel, as the filter's uncertainty
// would. What the filter is told about motion:
// - a measurement far from the estimate is motion: the pixel starts anew, at once;
// - measurements that keep lying on one side are slow motion: the longer and the
//   further, the higher the gain, so that the estimate follows closely;
// - otherwise it is noise, and the output changes only when the estimate has left
//   it by more than a part of the noise, so that still surfaces stand still.
// A pixel without measurement keeps its depth for a frame, and longer where it has
// come and gone before at the same distance, as the limits of the sensor's range
// make it flicker.
//
// 16-bit integers throughout, so that all variants agree.
#pragma once

#include "filter/depth_plane.h"
#include "filter/rules.h"

namespace theatron::filter {

// Parts of a depth unit in which the estimate is kept: 1/32.
inline constexpr int estimate_bits = 5;

struct KalmanRule {
    int noise_constant = 16;    // in 1/32 unit
    int noise_squared = 34000;  // times depth^2 / 2^32, in 1/32 unit; at most 0xffff
    int reset_sigmas = 5;       // at most 20
    int trend = 2048;           // in 1/4096 sigma
    int least_gain = 20;        // of 256
    int most_hold = 8;          // frames, at most 15
};

// The state of a pixel, packed into three numbers.
struct KalmanPixel {
    std::uint16_t depth = 0;  // as given out
    std::uint16_t estimate =
        0;                   // less depth, in 1/32 (high byte, signed); trend (low byte, signed)
    std::uint16_t gain = 0;  // of 256 (low byte); frames missing and to hold (4 bits each)
};

struct KalmanState {
    explicit KalmanState(Size size) : depth(size), estimate(size), gain(size) {}
    void clear() {
        depth.clear();
        estimate.clear();
        gain.clear();
    }
    DepthPlane depth, estimate, gain;
};

// One frame. `boost` is added to all gains: what was missed meanwhile.
void apply_kalman(const DepthPlane& in, const KalmanRule& rule, int boost, KalmanState& state,
                  MutableDepthView out);
void apply_kalman_reference(const DepthPlane& in, const KalmanRule& rule, int boost,
                            KalmanState& state, MutableDepthView out);

inline constexpr int most_noise = 1023;       // in 1/32 unit
inline constexpr int most_estimate = 127;     // in 1/32 unit
inline constexpr int gain_after_reset = 128;  // of 256
inline constexpr int hold_after_reset = 1;
// The least gain, of 256, where the mean innovation is beyond 1, 2, 3, 4 times the
// trend.
THEATRON_HD constexpr int trend_gain(int times) {
    return times == 1 ? 40 : times == 2 ? 90 : times == 3 ? 160 : 230;
}
inline constexpr int trend_steps = 4;
inline constexpr int least_dead_band = 24;  // in 1/32 unit
inline constexpr int most_dead_band = 112;

THEATRON_HD inline int noise_at(const KalmanRule& rule, int depth) {
    const int squared = (depth * std::int64_t(depth)) >> 16;
    return smaller(rule.noise_constant + int((std::int64_t(squared) * rule.noise_squared) >> 16),
                   most_noise);
}

// A measured pixel that is no jump. `innovation`: from the estimate, in 1/32.
THEATRON_HD inline KalmanPixel followed(const KalmanPixel& before, int innovation, int noise,
                                        const KalmanRule& rule, int boost) {
    const int rest = (before.estimate >> 8) - 128;
    int trend = (before.estimate & 0xff) - 128;
    int gain = smaller((before.gain & 0xff) + boost, 255);
    const int missing = (before.gain >> 8) & 0xf;
    int hold = before.gain >> 12;

    // A leaky sum of innovations, in half units: 8 times their recent mean.
    trend = clamped(trend - ((trend + 4) >> 3) + ((innovation + 8) >> 4), -127, 127);
    const int mean = 2 * (trend < 0 ? -trend : trend);  // in 1/32
    const int threshold = smaller(((noise << 4) * rule.trend) >> 16, 4095);
    int floor = rule.least_gain;
    for (int times = 1; times <= trend_steps; ++times)
        if (mean > times * threshold)
            floor = larger(floor, trend_gain(times));
    const bool moving = mean > threshold;
    gain = larger(gain, floor);

    const int moved = rest + ((innovation * gain + 128) >> 8);
    const int dead_band = moving ? 16 : clamped(noise >> 2, least_dead_band, most_dead_band);
    const int size = moved < 0 ? -moved : moved;
    const int step = size > dead_band ? (moved + 16) >> estimate_bits : 0;
    const int left = clamped(moved - (step << estimate_bits), -most_estimate, most_estimate);

    // Only what has long been still may be missing for long.
    if (missing > 0 && (before.gain & 0xff) <= 2 * rule.least_gain)
        hold = smaller(larger(hold, missing + 2), rule.most_hold);
    const int next_gain = larger(gain - ((gain * gain) >> 9), rule.least_gain);

    KalmanPixel after;
    after.depth = std::uint16_t(clamped(before.depth + step, 1, 0xffff));
    after.estimate = std::uint16_t(((left + 128) << 8) | (trend + 128));
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
    const int rest = (before.estimate >> 8) - 128;
    const int difference = clamped(measured - before.depth, -1000, 1000);
    const int innovation = (difference << estimate_bits) - rest;
    const bool jump = (innovation < 0 ? -innovation : innovation) > rule.reset_sigmas * noise;
    if (before.depth == none || jump) {
        KalmanPixel fresh;
        fresh.depth = std::uint16_t(measured);
        fresh.estimate = std::uint16_t((128 << 8) | 128);
        fresh.gain =
            std::uint16_t(gain_after_reset | (smaller(hold_after_reset, rule.most_hold) << 12));
        return fresh;
    }
    return followed(before, innovation, noise, rule, boost);
}

}  // namespace theatron::filter
