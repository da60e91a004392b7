// SPDX-License-Identifier: Apache-2.0
// The colour of each depth pixel, for programs that want both in one raster.
//
// Depth and colour cameras stand some centimetres apart. What the colour camera
// cannot see, because something nearer hides it, gets no colour; without that the
// foreground's colours are painted on the background beside it.
#pragma once

#include <vector>

#include "geometry/calibration.h"
#include "geometry/ray_table.h"
#include "image/image.h"

namespace theatron::filter {

// One camera. Made once; applying allocates nothing. Used by one thread at a time.
class ColorRegistration {
public:
    // The calibration has colour.
    explicit ColorRegistration(const Calibration& calibration);

    // Writes the colour of each depth pixel to `out`, and 255 to `seen`, or black
    // and 0 where there is no depth or the colour camera does not see it. Sizes
    // are those of the calibration; `out` and `seen` have the depth's.
    void apply(DepthView depth, ColorView color, MutableColorView out, View<std::uint8_t> seen);

private:
    struct Place {
        int x = -1, y = -1;  // in the colour picture; -1: outside
        float z = 0;         // metres, from the colour camera
    };
    void project_all(DepthView depth);

    Calibration calibration_;
    Image<Ray> rays_;
    int cell_;  // pixels of colour that one depth pixel covers, and more
    Size cells_;
    std::vector<Place> places_;
    std::vector<float> nearest_;  // of each cell
};

}  // namespace theatron::filter
