// SPDX-License-Identifier: Apache-2.0
// The statistics that characterise a depth sensor, real or modelled. For tests.
#pragma once

#include <array>
#include <cstddef>

#include "image/image.h"

namespace theatron::synthetic {

inline constexpr std::array<int, 7> distance_bounds_mm = {300, 700, 1200, 1800, 2500, 3500, 5000};
inline constexpr std::size_t distance_bins = distance_bounds_mm.size() - 1;

// Two consecutive frames of a static scene. Shares are in per cent.
struct PairStatistics {
    double valid = 0;
    double flips = 0;                // of all pixels: valid in one frame only
    double changed = 0;              // of all pixels
    std::array<double, 5> shares{};  // of valid differences: 0, +1, -1, +2, -2
    double correlation = 0;          // between differences of horizontal neighbours
    double correlation_2 = 0;        // between differences two pixels apart
    std::array<double, distance_bins> sigma{};
    std::array<double, distance_bins> pixels{};  // of all pixels
    double rvl_bits = 0;                         // per pixel, second frame
    double trvl_bits = 0;  // per pixel, second frame with the first as reference
};

PairStatistics measure_pair(const DepthImage& first, const DepthImage& second);

// Size in bits under Wilson's RVL, and under RVL of the change since a reference.
double rvl_bits(const DepthImage& depth);
double trvl_bits(const DepthImage& depth, const DepthImage& reference);

}  // namespace theatron::synthetic
