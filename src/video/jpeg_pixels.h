// SPDX-License-Identifier: Apache-2.0
// The arithmetic that turns coefficients into pixels: the numbers that the
// decoder's kernels share with jpeg_reference_native.cpp, which defines their
// results. Native builds only.
#pragma once

#include <array>
#include <cstdint>

#include "video/jpeg_zigzag.h"

namespace theatron::video::jpeg_pixels {

// The inverse DCT is the factorisation of Arai, Agui and Nakajima (1988): its
// scale factors, which come before additions and rotations, are multiplied into the
// steps of quantisation. Between its passes a sample has six bits after the point
// in 16, which leaves it four times the range of pixels.
inline constexpr int sample_bits = 6;

// Takes samples from around 0 to around 128, and rounds.
inline constexpr int sample_bias = (128 << sample_bits) + (1 << (sample_bits - 1));

// By position in zigzag order: the scaled value of a coefficient of 1 with a step of 1.
inline constexpr auto scales = [] {
    constexpr double factor[8] = {1, 1.3870398453221475, 1.3065629648763766, 1.1758756024193588,
                                  1, 0.7856949583871022, 0.5411961001461971, 0.2758993792829431};
    std::array<double, 64> all{};
    for (std::size_t k = 0; k < 64; ++k)
        all[k] = factor[jpeg_zigzag[k] / 8] * factor[jpeg_zigzag[k] % 8] / 8 * (1 << sample_bits);
    return all;
}();

// A step of quantisation and its scale as two factors in 16 bits: a coefficient is
// multiplied by `power`, wrapping around where no picture gets to, and then by
// `rest` / 32768, rounded.
struct ScaledStep {
    std::int16_t power, rest;
};

constexpr ScaledStep scaled_step(std::uint8_t step, std::size_t k) {
    const double scale = step * scales[k];
    int power = 1;
    while (power <= scale)
        power *= 2;
    const int rest = int(scale / power * 32768 + 0.5);
    return {std::int16_t(power), std::int16_t(rest < 32768 ? rest : 32767)};
}

// DC comes as the difference to another block's. It is summed up and scaled before
// the others are; its own factors leave it as it is.
inline constexpr ScaledStep dc_step{1, 32767};
constexpr std::int16_t scaled_dc(std::uint32_t sum, std::uint8_t step) {
    return std::int16_t(sum * step * ((1u << sample_bits) / 8) + std::uint32_t(sample_bias));
}

// In 1/32768, products are rounded: the rotations by 45 and 67.5 degrees ...
inline constexpr std::int16_t sqrt2_minus_1 = 13573;            // 1.41421
inline constexpr std::int16_t rotation_sine = 25080;            // 0.76537
inline constexpr std::int16_t rotation_cosine_minus_1 = 27779;  // 1.84776

// ... and JFIF's conversion to RGB, whose chroma has seven bits after the point.
inline constexpr int color_bits = 7;
inline constexpr std::int16_t red_minus_1 = 13173;   // 1.402
inline constexpr std::int16_t blue_minus_1 = 25297;  // 1.772
inline constexpr std::int16_t green_blue = 11277;    // 0.344136
inline constexpr std::int16_t green_red = 23401;     // 0.714136

}  // namespace theatron::video::jpeg_pixels
