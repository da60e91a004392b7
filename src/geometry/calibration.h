// SPDX-License-Identifier: Apache-2.0
// The parameters that turn the images of an RGB-D camera into points, and their encoding
// in messages and recordings (docs/formats/calibration.md).
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "geometry/camera_model.h"

namespace theatron {

struct Calibration {
    CameraModel depth;
    // Size 0 x 0 if the camera has no colour.
    CameraModel color;
    Pose color_from_depth;
    double depth_unit_mm = 1;  // millimetres per unit of a depth pixel

    // The pose of the depth camera in the room. Unless `registered`, it is a default: at eye
    // height above the origin, level, facing -z.
    Pose room_from_camera{Quat{0, 1, 0, 0}, Vec3{0, 1.5, 0}};
    bool registered = false;

    bool operator==(const Calibration&) const = default;
};

// Calibrations of larger pictures are refused: a few bytes from outside must not cause
// gigabytes to be allocated.
inline constexpr std::size_t max_depth_pixels = 2048 * 2048;
inline constexpr std::size_t max_color_pixels = 4096 * 3072;

Bytes encode_calibration(const Calibration& calibration);

// Safe for untrusted input. Refuses sizes out of range (Status::too_large), focal lengths that are
// not positive, and anything that is not finite.
Result<Calibration> decode_calibration(ByteView bytes);

}  // namespace theatron
