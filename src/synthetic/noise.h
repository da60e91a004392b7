// SPDX-License-Identifier: Apache-2.0
// Smooth pseudo-random fields for textures and folds: pure functions of the position, equal
// on every machine.
#pragma once

#include <cstdint>

#include "synthetic/vec3f.h"

namespace theatron::synthetic {

// An integer hash; neighbouring inputs give unrelated outputs.
constexpr std::uint32_t hash(std::uint32_t v) {
    v = (v ^ 61) ^ (v >> 16);
    v *= 9;
    v ^= v >> 4;
    v *= 0x27d4eb2d;
    return v ^ (v >> 15);
}
constexpr std::uint32_t hash(int x, int y, int z) {
    return hash(std::uint32_t(x) * 73856093u ^
                hash(std::uint32_t(y) * 19349663u ^ hash(std::uint32_t(z) * 83492791u)));
}
// Uniform, 0 to 1.
constexpr float hash01(std::uint32_t v) {
    return float(hash(v) >> 8) * (1.0f / 16777216.0f);
}

// Value noise, about -1 to 1, smooth, changes over a distance of about 1.
float noise(F3 p);

// Sum of `octaves` noises, each with twice the frequency and half the amplitude; -1 to 1.
float fractal(F3 p, int octaves);

// Distance to the nearest of scattered points, about one per unit cube: 0 to 1. `second`
// receives the distance to the second nearest.
float cells(F3 p, float* second = nullptr);

}  // namespace theatron::synthetic
