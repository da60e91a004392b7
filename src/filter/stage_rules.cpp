// SPDX-License-Identifier: Apache-2.0
#include "filter/stage_rules.h"

#include <algorithm>
#include <cmath>

namespace theatron::filter {
namespace {

std::uint16_t to_u16(double value) {
    return std::uint16_t(std::clamp(std::round(value), 0.0, 65535.0));
}

template <class Params>
Tolerance tolerance_of(const Params& params, const ChainCamera& camera) {
    return {to_u16(params.step_mm / camera.depth_unit_mm), to_u16(params.slope_1000 * 65.536)};
}

}  // namespace

FlyingPixelRule rule_of(const FlyingPixelParams& params, const ChainCamera& camera) {
    return {tolerance_of(params, camera), params.min_support};
}

SpeckleRule rule_of(const SpeckleParams& params, const ChainCamera& camera) {
    return {params.max_pixels, tolerance_of(params, camera)};
}

HoleRule rule_of(const HoleParams& params, const ChainCamera& camera) {
    return {params.iterations, params.max_size, params.min_neighbours,
            tolerance_of(params, camera)};
}

KalmanRule rule_of(const KalmanParams& params, const ChainCamera& camera) {
    const double steps = (1 << estimate_bits) / camera.depth_unit_mm;  // estimate units per mm
    const double metres = camera.depth_unit_mm / 1000;                 // metres per depth unit
    KalmanRule rule;
    rule.noise_constant = to_u16(camera.noise.constant_mm * steps);
    rule.noise_squared =
        to_u16(camera.noise.squared_mm * steps * metres * metres * 65536.0 * 65536.0);
    rule.reset_sigmas = params.reset_sigmas;
    rule.trend = to_u16(params.trend_sigmas_100 * 40.96);
    rule.least_gain = std::clamp(params.gain_1000 * 256 / 1000, 1, 255);
    rule.most_hold = params.hold_frames;
    return rule;
}

SteadyRule rule_of(const SteadyParams& params, const ChainCamera& camera) {
    SteadyRule rule;
    rule.tolerance_constant = to_u16(params.step_mm / camera.depth_unit_mm);
    // The parameter counts in millimetres at one metre, the rule in depth units.
    rule.tolerance_squared =
        to_u16(params.squared_mm * camera.depth_unit_mm / 1e6 * 65536.0 * 65536.0);
    rule.frames = params.frames;
    rule.together = params.together_100;
    rule.most_hold = params.hold_frames;
    return rule;
}

void narrow(Limits& limits, const RangeParams& params, const ChainCamera& camera) {
    limits.keep_range(to_u16(params.min_mm / camera.depth_unit_mm),
                      to_u16(params.max_mm / camera.depth_unit_mm));
}

void narrow(Limits& limits, const BackgroundParams& params, const ChainCamera& camera) {
    if (camera.background != nullptr)
        limits.remove_background(*camera.background, params.margin_mm, params.margin_sigmas,
                                 camera.noise, camera.depth_unit_mm);
}

}  // namespace theatron::filter
