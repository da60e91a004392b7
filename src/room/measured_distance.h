// SPDX-License-Identifier: Apache-2.0
// The distance between two points that depth cameras measured, and its uncertainty.
//
// Pure functions. Lengths are metres, cameras' frames have z forward (geometry/vec.h).
#pragma once

#include <array>
#include <cstdint>

#include "geometry/vec.h"

namespace theatron::room {

// A point of a live cloud.
struct MeasuredPoint {
    std::uint32_t camera = 0;
    Pose room_from_camera;
    Vec3 in_camera;
    double deviation_m = 0;    // of the measured distance, along the ray, for this pixel
    double pixel_radians = 0;  // the angle between neighbouring pixels
    // The camera's place, as in docs/formats/places.md: 6x6 row by row, a rotation about the
    // camera's axes in radians, then a translation along them. Zeros: exact, or not known.
    std::array<double, 36> placement{};
};

struct MeasuredDistance {
    double length_m = 0;
    double deviation_m = 0;  // standard deviation
};

// Propagates the variances of both points to their distance to first order (JCGM 100:2008, 5.1.2,
// equation 10): the noise along each ray, the uniform error of a pixel across it (its width squared
// over 12), and the errors of the two cameras' places. Between points of the same camera the error
// of its place cancels, because a rigid motion keeps distances. Errors of different cameras count
// as independent. The deviation is too small for lengths below about three times itself.
MeasuredDistance distance_between(const MeasuredPoint& a, const MeasuredPoint& b);

}  // namespace theatron::room
