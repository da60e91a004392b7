// SPDX-License-Identifier: Apache-2.0
// For tests: turns recorded frames into exact scenes that a model can be run on.
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

// Two frames of a static scene: depth from their mean, smoothed. No infrared
// image exists, so reflectivity is what the noise in the surroundings suggests
// for these parameters, and just about the limit where validity flickers.
Scene scene_from_pair(const DepthImage& first, const DepthImage& second,
                      const DepthSensorParams& params);

// One frame with its infrared image, which is the amplitude.
Scene scene_from_infrared(const DepthImage& depth, const DepthImage& infrared,
                          const DepthSensorParams& params);

}  // namespace theatron::synthetic
