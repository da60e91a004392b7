// SPDX-License-Identifier: Apache-2.0
#include "compare_words.h"

#include <array>

#include "svg_drawing.h"

namespace theatron::bench {
namespace {

constexpr std::array<const char*, 4> words = {"no visible difference", "small differences",
                                              "clear differences", "strong differences"};

// The lowest value of each word but the last, from the best on.
using Bounds = std::array<double, 3>;
constexpr Bounds psnr_bounds = {40, 30, 20}, ssim_bounds = {0.98, 0.9, 0.7};

std::string words_of(const Bounds& bounds, double value) {
    std::size_t i = 0;
    while (i < bounds.size() && value < bounds[i])
        ++i;
    return words[i];
}

std::string scale_of(const Bounds& bounds, const std::string& unit) {
    std::string text;
    for (std::size_t i = 0; i < bounds.size(); ++i)
        text += std::string(words[i]) + " from " + formatted("%g", bounds[i]) + unit +
                (i == 0 ? " on, " : ", ");
    return text + words.back() + " below.";
}

}  // namespace

std::string psnr_words(double db) {
    return words_of(psnr_bounds, db);
}

std::string ssim_words(double ssim) {
    return words_of(ssim_bounds, ssim);
}

std::string psnr_scale() {
    return "Likeness in dB (PSNR): " + scale_of(psnr_bounds, " dB");
}

std::string ssim_scale() {
    return "Likeness of shapes (SSIM, 1 is equal): " + scale_of(ssim_bounds, "");
}

}  // namespace theatron::bench
