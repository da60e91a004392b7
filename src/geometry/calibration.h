// SPDX-License-Identifier: Apache-2.0
// The parameters that turn the images of an RGB-D camera into points, and their encoding
// in messages and recordings (docs/formats/calibration.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/bytes.h"
#include "base/status.h"
#include "geometry/camera_model.h"

namespace theatron {

struct Calibration {
    // Size 0 x 0 if the camera has no depth; its place is then that of the colour camera.
    CameraModel depth;
    // Size 0 x 0 if the camera has no colour.
    CameraModel color;
    Pose color_from_depth;
    double depth_unit_mm = 1;  // millimetres per unit of a depth pixel

    // The pose of the depth camera in the room. Unless `registered`, it is a default: at eye
    // height above the origin, level, facing -z.
    Pose room_from_camera{Quat{0, 1, 0, 0}, Vec3{0, 1.5, 0}};
    bool registered = false;

    // In recordings: if it is not 0, the camera sees this participant of the recorded session, who
    // moves, and "the room" above is this person's frame (wire::CameraKind::person).
    std::uint32_t person = 0;

    // The number of one registration; cameras with the same number were placed together. 0:
    // unknown.
    std::uint64_t registration = 0;
    // Covariance of rotation about the camera's axes (radians), then translation along them
    // (metres), row by row; symmetric.
    std::optional<std::array<double, 36>> covariance;

    // Corrections that were measured once. Without them a viewer estimates its own.
    std::optional<double> depth_offset_mm;  // by which depth is too large, along the camera's axis
    std::optional<Vec3> color_gain;         // factors of red, green, blue sRGB values

    bool operator==(const Calibration&) const = default;
};

// Calibrations of larger pictures are refused: a few bytes from outside must not cause
// gigabytes to be allocated.
inline constexpr std::size_t max_depth_pixels = 2048 * 2048;
inline constexpr std::size_t max_color_pixels = 4096 * 3072;

// Larger corrections are refused.
inline constexpr double max_depth_offset_mm = 100, max_color_gain = 4;  // gains: also 1 / 4

// The camera where there is no such person: its place in the room is unknown.
Calibration without_person(Calibration calibration);

// The distance of a depth pixel along the camera's axis, in metres; 0 where nothing was measured.
inline double depth_m(const Calibration& calibration, std::uint16_t units) {
    const double mm = units * calibration.depth_unit_mm - calibration.depth_offset_mm.value_or(0);
    return units == 0 || mm < 0 ? 0 : mm / 1000;
}

// In version 2 of the format.
Bytes encode_calibration(const Calibration& calibration);

// Reads version 1 and 2. Safe for untrusted input. Refuses sizes out of range (Status::too_large),
// focal lengths that are not positive, cameras without any lens, and anything that is not finite.
// Fields of a newer program are skipped.
Result<Calibration> decode_calibration(ByteView bytes);

}  // namespace theatron
