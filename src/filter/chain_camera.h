// SPDX-License-Identifier: Apache-2.0
// The properties of a camera that its filters depend on.
#pragma once

#include "filter/background.h"
#include "filter/noise_model.h"
#include "image/view.h"

namespace theatron::filter {

struct ChainCamera {
    Size size;
    double depth_unit_mm = 1;
    // The recorded empty scene, for the filter `background`; read only while the chain is
    // made. Null or of another size: that filter does nothing.
    const Background* background = nullptr;
    NoiseModel noise;
};

}  // namespace theatron::filter
