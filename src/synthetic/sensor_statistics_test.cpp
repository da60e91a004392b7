// SPDX-License-Identifier: Apache-2.0
#include "synthetic/sensor_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "base/bytes.h"
#include "codec/rvl.h"
#include "codec/trvl.h"

namespace theatron::synthetic {
namespace {

// Larger differences are motion or another surface, not noise.
constexpr int max_noise_mm = 12;

}  // namespace

double rvl_bits(const DepthImage& depth) {
    Bytes bytes(codec::rvl::max_encoded_size(depth.size));
    return 8.0 * double(codec::rvl::encode(depth.view(), bytes));
}

double trvl_bits(const DepthImage& depth, const DepthImage& reference) {
    Bytes bytes(codec::trvl::max_encoded_size(depth.size));
    std::vector<std::uint16_t> scratch(depth.size.area());
    return 8.0 * double(codec::trvl::encode(depth.view(), reference.view(), scratch, bytes));
}

PairStatistics measure_pair(const DepthImage& first, const DepthImage& second) {
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

TEST(SensorStatistics, AreThoseOfASmallPair) {
    DepthImage first({4, 2}), second({4, 2});
    first.pixels = {1000, 1000, 1000, 0, 2000, 2000, 2000, 2000};
    second.pixels = {1002, 1001, 1000, 9, 2000, 1999, 0, 2050};
    const PairStatistics s = measure_pair(first, second);
    EXPECT_DOUBLE_EQ(s.valid, 100 * 7 / 8.0);
    EXPECT_DOUBLE_EQ(s.flips, 100 * 2 / 8.0);
    EXPECT_DOUBLE_EQ(s.changed, 100 * 6 / 8.0);
    EXPECT_DOUBLE_EQ(s.shares[0], 100 * 2 / 6.0);  // 0
    EXPECT_DOUBLE_EQ(s.shares[1], 100 * 1 / 6.0);  // +1
    EXPECT_DOUBLE_EQ(s.shares[2], 100 * 1 / 6.0);  // -1
    EXPECT_DOUBLE_EQ(s.shares[3], 100 * 1 / 6.0);  // +2
    EXPECT_DOUBLE_EQ(s.shares[4], 0);              // -2
    EXPECT_DOUBLE_EQ(s.sigma[1], std::sqrt(5 / 3.0 / 2));
    EXPECT_DOUBLE_EQ(s.sigma[3], std::sqrt(1 / 2.0 / 2));  // without the one that jumps
    // Neighbours 2 1, 1 0 and 0 -1.
    EXPECT_DOUBLE_EQ(s.correlation, 2 / (2.5 + 0.5 + 0.5));
}

}  // namespace theatron::synthetic
