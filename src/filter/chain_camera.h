// SPDX-License-Identifier: Apache-2.0
// What the filters must know of a camera.
#pragma once

#include "filter/background.h"
#include "filter/noise_model.h"
#include "image/view.h"

namespace theatron::filter {

struct ChainCamera {
    Size size;
    double depth_unit_mm = 1;
    // The recorded empty scene, for the step `background`; read while the chain is
    // made. Without one of the camera's size that step does nothing.
    const Background* background = nullptr;
    NoiseModel noise;
};

}  // namespace theatron::filter
