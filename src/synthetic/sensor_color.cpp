// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

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

// How one channel answers to each value: mean and noise, in steps of 255.
struct Response {
    std::array<float, 256> mean;
    std::array<float, 256> deviation;

    Response(float gain, float mid_grey_noise) {
        for (int v = 0; v < 256; ++v) {
            const float light = std::min(gain * linear_from_srgb(float(v) / 255), 1.0f);
            mean[std::size_t(v)] = 255 * srgb_from_linear(light);
            // Shot noise grows with the root of the light, which the sRGB curve
            // nearly cancels; clipped pixels have none.
            deviation[std::size_t(v)] = light < 1 ? mid_grey_noise : 0;
        }
    }
};

}  // namespace

void apply_color_sensor(const ColorSensorParams& params, std::uint32_t seed, std::uint32_t frame,
                        ColorView picture, MutableColorView out) {
    assert(picture.size == out.size);
    const std::uint32_t camera = noise_key(seed, 0, 100);
    const float exposure = std::exp2(params.exposure_stops * normal_at(camera, 0));
    const Response red(exposure * (1 + params.white_balance * normal_at(camera, 1)), params.noise);
    const Response green(exposure, params.noise);
    const Response blue(exposure * (1 + params.white_balance * normal_at(camera, 2)), params.noise);

    const auto answer = [](const Response& response, std::uint8_t value, float noise) {
        const float level = response.mean[value] + response.deviation[value] * noise;
        return std::uint8_t(std::clamp(level + 0.5f, 0.0f, 255.0f));
    };
    for (int y = 0; y < picture.size.height; ++y) {
        const std::uint32_t key =
            noise_key(seed, frame, 101) + std::uint32_t(y) * 3 * std::uint32_t(max_side);
        const Rgb* in = picture.row(y);
        Rgb* row = out.row(y);
        for (int x = 0; x < picture.size.width; ++x) {
            const std::uint32_t at = std::uint32_t(x) * 3;
            row[x] = {answer(red, in[x].r, normal_at(key, at)),
                      answer(green, in[x].g, normal_at(key, at + 1)),
                      answer(blue, in[x].b, normal_at(key, at + 2))};
        }
    }
}

}  // namespace theatron::synthetic
