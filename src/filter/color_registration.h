// SPDX-License-Identifier: Apache-2.0
// The colour of each depth pixel, for programs that need both in one raster.
//
// Depth and colour cameras are some centimetres apart. A depth pixel that the colour camera
// cannot see, because a nearer surface hides it, gets no colour; otherwise the foreground's
// colours would appear on the background beside it.
#pragma once

#include <vector>

#include "geometry/calibration.h"
#include "geometry/ray_table.h"
#include "image/image.h"

namespace theatron::filter {

// For one camera. apply() does not allocate. One thread at a time.
class ColorRegistration {
public:
    // Precondition: the calibration has a colour camera.
    explicit ColorRegistration(const Calibration& calibration);

    // Writes the colour of each depth pixel to `out` and 255 to `seen`; black and 0 if the
    // pixel has no depth or is hidden from the colour camera. `depth` and `color` have the
    // calibration's sizes; `out` and `seen` have the size of `depth`.
    void apply(DepthView depth, ColorView color, MutableColorView out, View<std::uint8_t> seen);

private:
    struct Place {
        int x = -1, y = -1;  // in the colour picture; -1: outside
        float z = 0;         // metres, from the colour camera
    };
    void project_all(DepthView depth);

    Calibration calibration_;
    Image<Ray> rays_;
    int cell_;  // side in colour pixels, slightly more than a depth pixel covers
    Size cells_;
    std::vector<Place> places_;
    std::vector<float> nearest_;  // per cell, metres
};

}  // namespace theatron::filter
