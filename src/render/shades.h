// SPDX-License-Identifier: Apache-2.0
// A picture for a camera without colour: grey by the direction of its surface, as in a light that
// comes from above and left behind the camera. Flat grey would show no shape.
#pragma once

#include "geometry/calibration.h"
#include "image/image.h"

namespace theatron::render {

// Half the size of the depth image on each side, which is a quarter of the work. Surfaces that
// face the light are light grey; pixels without a measurement or without a measured neighbour on
// the same surface get the grey of one that faces the camera.
void shade(DepthView depth, const Calibration& calibration, ColorImage& out);

}  // namespace theatron::render
