// SPDX-License-Identifier: Apache-2.0
// The modelled Azure Kinect that the tests see boards with.
#pragma once

#include "registration/board_scene.h"
#include "synthetic/operating_room.h"
#include "synthetic/sensor_model.h"

namespace theatron::registration {

inline CameraModel azure_camera() {
    return synthetic::synthetic_camera(synthetic::Variant::room, 0, 1, {}).depth;
}

// Only random noise: errors that are the same in all frames are off.
inline synthetic::DepthSensorParams noise_alone() {
    synthetic::DepthSensorParams params = synthetic::nfov_unbinned();
    params.offset_mm = params.scale = params.wiggle_mm = params.field_mm = params.fixed_mm = 0;
    params.multipath = 0;
    return params;
}

}  // namespace theatron::registration
