// SPDX-License-Identifier: Apache-2.0
// Windowing: from measured values to greys, as DICOM defines it (PS3.3, C.11.2.1.2, the linear
// function).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "medical/volume.h"

namespace theatron::medical {

struct WindowPreset {
    std::string_view name;
    Window window;  // in Hounsfield units
};

// Usual windows of CT images, the most general first.
std::span<const WindowPreset> window_presets();

// The grey of a value, 0 darkest. `window.width` is above 0. `slope` is that of the volume: values
// that lie closer together than 1 have a window that may be narrower than 1.
std::uint8_t grey_of(double value, Window window, double slope = 1);

// The greys of all samples of one volume in one window, so that a picture costs one look-up a
// pixel. Used by any number of threads.
class GreyTable {
public:
    GreyTable(Window window, double slope, double intercept, bool inverted);
    GreyTable(Window window, const Volume& volume)
        : GreyTable(window, volume.slope, volume.intercept, volume.inverted) {}

    std::uint8_t operator[](std::int16_t sample) const {
        return greys_[std::size_t(sample + 32768)];
    }

private:
    std::vector<std::uint8_t> greys_;
};

}  // namespace theatron::medical
