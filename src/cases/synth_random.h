// SPDX-License-Identifier: Apache-2.0
// Numbers of generated cases, the same on every machine: only +, -, *, / and square roots, which
// IEEE 754 fixes to the last bit.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/split_mix.h"
#include "geometry/vec.h"

namespace theatron::cases {

class SynthRandom {
public:
    explicit SynthRandom(std::uint64_t seed) : numbers_(seed) {}
    std::uint64_t next() { return numbers_.next(); }
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
    SplitMix numbers_;
};

// Newton's iteration; `value` above 0.
inline double cube_root(double value) {
    double root = value > 1 ? value / 3 + 1 : 1;
    for (int i = 0; i < 60; ++i)
        root = (2 * root + value / (root * root)) / 3;
    return root;
}

}  // namespace theatron::cases
