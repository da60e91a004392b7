// SPDX-License-Identifier: Apache-2.0
// The projection of a camera: pinhole with the rational Brown-Conrady distortion (six
// radial, two tangential coefficients) of OpenCV and Azure Kinect. All distortion zero is
// the plain pinhole.
//
// Pixel coordinates: the centre of the top left pixel is (0, 0).
#pragma once

#include <array>
#include <optional>

#include "geometry/vec.h"
#include "image/view.h"

namespace theatron {

struct CameraModel {
    Size size;
    double fx = 0, fy = 0, cx = 0, cy = 0;  // pixels
    std::array<double, 6> k{};              // k1 … k6
    double p1 = 0, p2 = 0;
    // Directions further than this from the axis (x/z, y/z) are not imaged, because the
    // polynomial is not valid there. 0: no limit.
    double max_radius = 0;

    bool operator==(const CameraModel&) const = default;
};

// A pinhole camera without distortion, with this horizontal field of view.
CameraModel pinhole(Size size, double horizontal_fov_degrees);

// The pixel of `point` (camera frame, any length unit); nullopt behind the camera and beyond
// max_radius. May lie outside the image.
std::optional<Vec2> project(const CameraModel& camera, Vec3 point);

// The direction (x/z, y/z) of `pixel`, by Newton iteration; nullopt if that does not converge
// or the direction is beyond max_radius.
std::optional<Vec2> unproject(const CameraModel& camera, Vec2 pixel);

// The same camera with its pictures scaled to `size`.
CameraModel scaled(const CameraModel& camera, Size size);

}  // namespace theatron
