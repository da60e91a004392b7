// SPDX-License-Identifier: Apache-2.0
// For tests: the figures by which a depth sensor, real or modelled, is described.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/bytes.h"
#include "codec/rvl.h"
#include "codec/trvl.h"
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
    double correlation = 0;          // of the differences of horizontal neighbours
    double correlation_2 = 0;        // and of those two pixels apart
    std::array<double, distance_bins> sigma{};
    std::array<double, distance_bins> pixels{};  // of all pixels
    double rvl_bits = 0;                         // per pixel, second frame
    double trvl_bits = 0;  // per pixel, second frame with the first as reference
};

// Size in bits as Wilson's RVL, or as the change since a reference.
inline double rvl_bits(const DepthImage& depth) {
    Bytes bytes(codec::rvl::max_encoded_size(depth.size));
    return 8.0 * double(codec::rvl::encode(depth.view(), bytes));
}

inline double trvl_bits(const DepthImage& depth, const DepthImage& reference) {
    Bytes bytes(codec::trvl::max_encoded_size(depth.size));
    std::vector<std::uint16_t> scratch(depth.size.area());
    return 8.0 * double(codec::trvl::encode(depth.view(), reference.view(), scratch, bytes));
}

// Differences beyond this are movement or another surface, not noise.
inline constexpr int max_noise_mm = 12;

inline PairStatistics measure_pair(const DepthImage& first, const DepthImage& second) {
    const Size size = first.size;
    const double percent = 100.0 / double(size.area());
    PairStatistics s;
    std::vector<std::int32_t> change(size.area());
    std::array<double, distance_bins> squares{}, counts{};
    double both = 0;
    std::array<double, 5> values{};
    for (std::size_t i = 0; i < size.area(); ++i) {
        const int a = first.pixels[i], b = second.pixels[i];
        change[i] = b - a;
        s.valid += percent * (b != 0);
        s.flips += percent * ((a != 0) != (b != 0));
        s.changed += percent * (a != b);
        if (a == 0 || b == 0)
            continue;
        ++both;
        for (std::size_t k = 0; k < 5; ++k)
            values[k] += change[i] == (k % 2 ? int(k + 1) / 2 : -int(k) / 2);
        if (std::abs(change[i]) > max_noise_mm)
            continue;
        for (std::size_t bin = 0; bin < distance_bins; ++bin) {
            if (a >= distance_bounds_mm[bin] && a < distance_bounds_mm[bin + 1]) {
                squares[bin] += double(change[i]) * change[i];
                ++counts[bin];
            }
        }
    }
    for (std::size_t k = 0; k < 5; ++k)
        s.shares[k] = 100 * values[k] / both;
    for (std::size_t bin = 0; bin < distance_bins; ++bin) {
        s.sigma[bin] = counts[bin] > 0 ? std::sqrt(squares[bin] / counts[bin] / 2) : 0;
        s.pixels[bin] = percent * counts[bin];
    }

    const auto is_noise = [&](std::size_t i) {
        return first.pixels[i] && second.pixels[i] && std::abs(change[i]) <= max_noise_mm;
    };
    const auto correlation = [&](int lag) {
        double products = 0, energy = 0;
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x + lag < size.width; ++x) {
                const std::size_t i = std::size_t(y * size.width + x), j = i + std::size_t(lag);
                if (!is_noise(i) || !is_noise(j))
                    continue;
                products += double(change[i]) * change[j];
                energy += (double(change[i]) * change[i] + double(change[j]) * change[j]) / 2;
            }
        }
        return products / energy;
    };
    s.correlation = correlation(1);
    s.correlation_2 = correlation(2);
    s.rvl_bits = rvl_bits(second) / double(size.area());
    s.trvl_bits = trvl_bits(second, first) / double(size.area());
    return s;
}

}  // namespace theatron::synthetic
