// SPDX-License-Identifier: Apache-2.0
// What must be known of an RGB-D camera to turn its images into points, and the
// bytes in which it travels and is recorded (docs/formats/calibration.md).
#pragma once

#include "base/bytes.h"
#include "base/status.h"
#include "geometry/camera_model.h"

namespace theatron {

struct Calibration {
    CameraModel depth;
    // Size 0 x 0 where the camera gives no colour.
    CameraModel color;
    Pose color_from_depth;
    double depth_unit_mm = 1;  // millimetres per step of a depth pixel

    // Where the depth camera is in the room. Until it is `registered` that is a
    // guess: at eye height above the origin, level, looking along -z.
    Pose room_from_camera{Quat{0, 1, 0, 0}, Vec3{0, 1.5, 0}};
    bool registered = false;

    bool operator==(const Calibration&) const = default;
};

// Pictures of more pixels than any camera gives are refused with their calibration: a few bytes
// from outside must not make anybody take gigabytes.
inline constexpr std::size_t max_depth_pixels = 2048 * 2048;
inline constexpr std::size_t max_color_pixels = 4096 * 3072;

Bytes encode_calibration(const Calibration& calibration);

// Safe for untrusted input. Refuses sizes out of range (Status::too_large), focal lengths that are
// not positive, and anything that is not finite.
Result<Calibration> decode_calibration(ByteView bytes);

}  // namespace theatron
