// SPDX-License-Identifier: Apache-2.0
// Lens correction without resampling: the direction of each depth pixel.
#pragma once

#include "geometry/camera_model.h"
#include "image/image.h"

namespace theatron {

// A direction (x/z, y/z): the point of depth z lies at (x*z, y*z, z).
struct Ray {
    float x = 0, y = 0;
    bool operator==(const Ray&) const = default;
};

// Marks pixels outside the lens' valid circle.
inline constexpr float no_ray = 1e9f;

// One ray per pixel of `camera`. Takes some tens of milliseconds: compute it once.
Image<Ray> make_ray_table(const CameraModel& camera);

}  // namespace theatron
