// SPDX-License-Identifier: Apache-2.0
// Converts recorded frames to exact scenes, the input of a sensor model. For tests.
#pragma once

#include "image/image.h"
#include "synthetic/sensor_model.h"

namespace theatron::synthetic {

struct Scene {
    Image<float> depth_m, reflectivity, cos_incidence;

    DepthTruth truth() const {
        return {depth_m.view(), reflectivity.view(), cos_incidence.view(), {}};
    }
};

// From two frames of a static scene. Depth is their mean, smoothed. There is no infrared
// image, so reflectivity is estimated from the noise around each pixel for these parameters,
// and lies near the limit where validity flickers.
Scene scene_from_pair(const DepthImage& first, const DepthImage& second,
                      const DepthSensorParams& params);

// From one frame with its infrared image, which gives the amplitude.
Scene scene_from_infrared(const DepthImage& depth, const DepthImage& infrared,
                          const DepthSensorParams& params);

}  // namespace theatron::synthetic
