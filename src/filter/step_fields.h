// SPDX-License-Identifier: Apache-2.0
// Names and parameters of all filters in one table, for parsing and spelling.
#pragma once

#include <span>

#include "filter/chain_settings.h"

namespace theatron::filter {

template <class Params>
struct Field {
    const char* name;
    int Params::*value;
    int min, max;
};

template <class Params>
struct StepFields;

template <>
struct StepFields<RangeParams> {
    static constexpr const char* name = "range";
    static constexpr Field<RangeParams> fields[] = {
        {"min_mm", &RangeParams::min_mm, 0, 65535},
        {"max_mm", &RangeParams::max_mm, 1, 65535},
    };
};

template <>
struct StepFields<BackgroundParams> {
    static constexpr const char* name = "background";
    static constexpr Field<BackgroundParams> fields[] = {
        {"margin_mm", &BackgroundParams::margin_mm, 0, 1000},
        {"margin_sigmas", &BackgroundParams::margin_sigmas, 0, 100},
    };
};

template <>
struct StepFields<FlyingPixelParams> {
    static constexpr const char* name = "flying_pixels";
    static constexpr Field<FlyingPixelParams> fields[] = {
        {"step_mm", &FlyingPixelParams::step_mm, 0, 1000},
        {"slope_1000", &FlyingPixelParams::slope_1000, 0, 999},
        {"min_support", &FlyingPixelParams::min_support, 1, 8},
    };
};

template <>
struct StepFields<SpeckleParams> {
    static constexpr const char* name = "speckles";
    static constexpr Field<SpeckleParams> fields[] = {
        {"max_pixels", &SpeckleParams::max_pixels, 1, 100000},
        {"step_mm", &SpeckleParams::step_mm, 0, 1000},
        {"slope_1000", &SpeckleParams::slope_1000, 0, 999},
    };
};

template <>
struct StepFields<HoleParams> {
    static constexpr const char* name = "holes";
    static constexpr Field<HoleParams> fields[] = {
        {"iterations", &HoleParams::iterations, 1, 64},
        {"max_size", &HoleParams::max_size, 1, 31},
        {"min_neighbours", &HoleParams::min_neighbours, 1, 8},
        {"step_mm", &HoleParams::step_mm, 0, 1000},
        {"slope_1000", &HoleParams::slope_1000, 0, 999},
    };
};

template <>
struct StepFields<KalmanParams> {
    static constexpr const char* name = "kalman";
    static constexpr Field<KalmanParams> fields[] = {
        {"gain_1000", &KalmanParams::gain_1000, 20, 1000},
        {"reset_sigmas", &KalmanParams::reset_sigmas, 1, 20},
        {"trend_sigmas_100", &KalmanParams::trend_sigmas_100, 0, 1000},
        {"hold_frames", &KalmanParams::hold_frames, 0, 15},
    };
};

template <>
struct StepFields<SteadyParams> {
    static constexpr const char* name = "steady";
    static constexpr Field<SteadyParams> fields[] = {
        {"step_mm", &SteadyParams::step_mm, 0, 1000},
        {"squared_mm", &SteadyParams::squared_mm, 0, 15},
        {"frames", &SteadyParams::frames, 1, 100},
        {"together_100", &SteadyParams::together_100, 1, 100},
        {"hold_frames", &SteadyParams::hold_frames, 0, 15},
    };
};

}  // namespace theatron::filter
