// SPDX-License-Identifier: Apache-2.0
// Random numbers that are the same with every standard library: what a seed gives is part of what
// tests and figures state. SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace theatron::face {

class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }
    // From 0 to below 1.
    double unit() { return double(bits() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    std::size_t below(std::size_t count) { return std::size_t(unit() * double(count)); }
    bool chance(double probability) { return unit() < probability; }
    // Mean 0, deviation 1 (Box and Muller, 1958).
    double normal() {
        return std::sqrt(-2 * std::log(1 - unit())) * std::cos(2 * std::numbers::pi * unit());
    }

private:
    std::uint64_t state_;
};

}  // namespace theatron::face
