// SPDX-License-Identifier: Apache-2.0
// Random numbers as functions of place and frame, not of a sequence: pixel 17 of frame 3 gets
// the same noise regardless of what was computed before.
#pragma once

#include <cstdint>
#include <vector>

#include "image/view.h"

namespace theatron::synthetic {

// An integer hash; neighbouring inputs give unrelated outputs. Constants:
// "lowbias32" of C. Wellons' hash-prospector (public domain).
constexpr std::uint32_t mix_bits(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

// The use of a random number, part of its key.
enum NoiseUse : std::uint32_t {
    depth_noise,
    mixing_noise,
    distance_errors,
    slow_errors,
    fixed_errors,
    color_gains,
    color_noise,
};

// A key for one use of one camera's noise in one frame.
constexpr std::uint32_t noise_key(std::uint32_t seed, std::uint32_t frame, NoiseUse use) {
    return mix_bits(mix_bits(mix_bits(seed + 0x9e3779b9u) + frame) + use * 0x85ebca6bu);
}

// Approximately normal with variance 1, at most 3.45 in size: the sum of four bytes.
constexpr float normal_from_bits(std::uint32_t bits) {
    const int sum =
        int(bits & 0xff) + int(bits >> 8 & 0xff) + int(bits >> 16 & 0xff) + int(bits >> 24);
    return float(sum - 510) * 0.0067658f;  // 1 / sqrt(4 (256^2 - 1) / 12)
}

constexpr float normal_at(std::uint32_t key, std::uint32_t index) {
    return normal_from_bits(mix_bits(key + index));
}

// Uniform between 0 and 1.
constexpr float uniform_at(std::uint32_t key, std::uint32_t index) {
    return float(mix_bits(key + index) >> 8) * (1.0f / 16777216.0f);
}

// An image of normal noise with variance 1 and correlated neighbours, as after the smoothing
// inside a depth camera.
class NoiseField {
public:
    // `white_share` of the variance is independent per pixel. The rest is filtered by a
    // Gaussian with a standard deviation of `radius_px`.
    NoiseField(Size size, float radius_px, float white_share);

    // Computes the field of this key. The view is valid until the next call.
    View<const float> draw(std::uint32_t key);

private:
    static constexpr int reach = 4;  // taps on each side

    Size size_;
    float taps_[2 * reach + 1];
    float white_weight_;
    std::vector<float> wide_row_;  // one row of white noise with margins
    std::vector<float> across_;    // smoothed along rows, with margins above and below
    std::vector<float> field_;
};

}  // namespace theatron::synthetic
