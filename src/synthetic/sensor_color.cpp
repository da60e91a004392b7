// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "synthetic/sensor_model.h"
#include "synthetic/sensor_random.h"

namespace theatron::synthetic {
namespace {

float linear_from_srgb(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

float srgb_from_linear(float v) {
    return v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

// The response of one colour channel to each value.
class Response {
public:
    Response(float gain, float noise) {
        for (int v = 0; v < 256; ++v) {
            const float light = std::min(gain * linear_from_srgb(float(v) / 255), 1.0f);
            // Plus one half, so that truncation rounds.
            mean_[std::size_t(v)] = 255 * srgb_from_linear(light) + 0.5f;
            // Shot noise grows with the square root of the light, which the sRGB curve nearly
            // cancels. Clipped pixels have none.
            deviation_[std::size_t(v)] = light < 1 ? noise : 0;
        }
    }

    std::uint8_t answer(std::uint8_t value, float noise) const {
        const int level = int(mean_[value] + deviation_[value] * noise);
        return std::uint8_t(std::clamp(level, 0, 255));
    }

private:
    std::array<float, 256> mean_;
    std::array<float, 256> deviation_;
};

}  // namespace

void apply_color_sensor(const ColorSensorParams& params, std::uint32_t seed, std::uint32_t frame,
                        ColorView picture, MutableColorView out) {
    assert(picture.size == out.size);
    const std::uint32_t camera = noise_key(seed, 0, color_gains);
    const float exposure = std::exp2(params.exposure_stops * normal_at(camera, 0));
    const Response red(exposure * (1 + params.white_balance * normal_at(camera, 1)), params.noise);
    const Response green(exposure, params.noise);
    const Response blue(exposure * (1 + params.white_balance * normal_at(camera, 2)), params.noise);

    const std::size_t values = 3 * std::size_t(picture.size.width);
    std::vector<float> noise(values);
    for (int y = 0; y < picture.size.height; ++y) {
        const std::uint32_t key =
            noise_key(seed, frame, color_noise) + std::uint32_t(y) * std::uint32_t(values);
        for (std::size_t i = 0; i < values; ++i)
            noise[i] = normal_at(key, std::uint32_t(i));

        const std::uint8_t* in = &picture.row(y)->r;
        std::uint8_t* level = &out.row(y)->r;
        for (std::size_t i = 0; i < values; i += 3) {
            level[i] = red.answer(in[i], noise[i]);
            level[i + 1] = green.answer(in[i + 1], noise[i + 1]);
            level[i + 2] = blue.answer(in[i + 2], noise[i + 2]);
        }
    }
}

}  // namespace theatron::synthetic
