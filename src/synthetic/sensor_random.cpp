// SPDX-License-Identifier: Apache-2.0
#include "synthetic/sensor_random.h"

#include <cmath>

namespace theatron::synthetic {

NoiseField::NoiseField(Size size, float radius_px, float white_share)
    : size_(size),
      white_weight_(std::sqrt(white_share)),
      wide_row_(std::size_t(size.width + 2 * reach)),
      across_(std::size_t(size.width) * std::size_t(size.height + 2 * reach)),
      field_(size.area()) {
    float energy = 0;
    for (int i = -reach; i <= reach; ++i) {
        const float tap = std::exp(-0.5f * float(i * i) / (radius_px * radius_px));
        taps_[i + reach] = tap;
        energy += tap * tap;
    }
    // Two passes, each with the square root of the scale.
    const float scale = std::sqrt(std::sqrt(1 - white_share) / energy);
    for (float& tap : taps_)
        tap *= scale;
}

View<const float> NoiseField::draw(std::uint32_t key) {
    const int width = size_.width;
    const int wide = width + 2 * reach;
    for (int y = 0; y < size_.height + 2 * reach; ++y) {
        const std::uint32_t row_key = key + std::uint32_t(y * wide);
        for (int x = 0; x < wide; ++x)
            wide_row_[std::size_t(x)] = normal_at(row_key, std::uint32_t(x));
        float* out = across_.data() + std::size_t(y) * std::size_t(width);
        for (int x = 0; x < width; ++x)
            out[x] = taps_[0] * wide_row_[std::size_t(x)];
        for (int tap = 1; tap <= 2 * reach; ++tap) {
            const float weight = taps_[tap];
            const float* in = wide_row_.data() + tap;
            for (int x = 0; x < width; ++x)
                out[x] += weight * in[x];
        }
    }

    const std::uint32_t white_key = mix_bits(key);
    for (int y = 0; y < size_.height; ++y) {
        float* out = field_.data() + std::size_t(y) * std::size_t(width);
        const std::uint32_t row_key = white_key + std::uint32_t(y * width);
        for (int x = 0; x < width; ++x)
            out[x] = white_weight_ * normal_at(row_key, std::uint32_t(x));
        for (int tap = 0; tap <= 2 * reach; ++tap) {
            const float weight = taps_[tap];
            const float* in = across_.data() + std::size_t(y + tap) * std::size_t(width);
            for (int x = 0; x < width; ++x)
                out[x] += weight * in[x];
        }
    }
    return {field_.data(), size_};
}

}  // namespace theatron::synthetic
