// SPDX-License-Identifier: Apache-2.0
#include "medical/window.h"

#include <algorithm>
#include <cmath>

namespace theatron::medical {
namespace {

constexpr WindowPreset presets[] = {
    {"abdomen", {40, 400}}, {"liver", {90, 180}},  {"vessels", {200, 600}},
    {"lung", {-600, 1500}}, {"bone", {400, 1800}}, {"brain", {40, 80}},
};

}  // namespace

std::span<const WindowPreset> window_presets() {
    return presets;
}

std::uint8_t grey_of(double value, Window window, double slope) {
    // DICOM's steps of 1, of which measured values below 1 (SUV, mm2/s) have many.
    const double step = std::min(1.0, std::abs(slope));
    const double center = window.center - step / 2, width = std::max(window.width - step, 0.0);
    if (value <= center - width / 2)
        return 0;
    if (value > center + width / 2)
        return 255;
    return std::uint8_t(std::clamp(((value - center) / width + 0.5) * 255 + 0.5, 0.0, 255.0));
}

GreyTable::GreyTable(Window window, double slope, double intercept, bool inverted) : greys_(65536) {
    for (int sample = -32768; sample < 32768; ++sample) {
        const std::uint8_t grey = grey_of(slope * sample + intercept, window, slope);
        greys_[std::size_t(sample + 32768)] = inverted ? std::uint8_t(255 - grey) : grey;
    }
}

}  // namespace theatron::medical
