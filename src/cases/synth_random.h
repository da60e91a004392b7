// SPDX-License-Identifier: Apache-2.0
// Numbers of generated cases, the same on every machine: only +, -, *, / and square roots, which
// IEEE 754 fixes to the last bit.
#pragma once

#include <cmath>
#include <cstdint>

#include "geometry/vec.h"

namespace theatron::cases {

// SplitMix64 (Steele, Lea and Flood 2014).
inline std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

class SynthRandom {
public:
    explicit SynthRandom(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next() { return mixed(state_ += 0x9e3779b97f4a7c15u); }
    double between(double low, double high) {
        return low + (high - low) * (double(next() >> 11) * 0x1p-53);
    }
    Vec3 direction() {
        while (true) {
            const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
            const double l = x * x + y * y + z * z;
            if (l > 0.01 && l < 1)
                return Vec3{x, y, z} * (1 / std::sqrt(l));
        }
    }

private:
    std::uint64_t state_;
};

// Newton's iteration; `value` above 0.
inline double cube_root(double value) {
    double root = value > 1 ? value / 3 + 1 : 1;
    for (int i = 0; i < 60; ++i)
        root = (2 * root + value / (root * root)) / 3;
    return root;
}

}  // namespace theatron::cases
