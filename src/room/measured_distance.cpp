// SPDX-License-Identifier: Apache-2.0
#include "room/measured_distance.h"

#include <algorithm>

namespace theatron::room {
namespace {

// Both in the camera's frame; `along` of length 1: the variance of the point's coordinate along it.
double noise_variance(const MeasuredPoint& point, Vec3 along) {
    const double reach = length(point.in_camera);
    const double on_ray = reach > 0 ? dot(point.in_camera, along) / reach : 0;
    const double pixel_m = point.pixel_radians * reach;
    return point.deviation_m * point.deviation_m * on_ray * on_ray +
           pixel_m * pixel_m / 12 * (1 - on_ray * on_ray);
}

double placement_variance(const MeasuredPoint& point, Vec3 along) {
    // A small motion (w, t) moves the point by cross(w, p) + t, and its coordinate by this
    // gradient.
    const Vec3 turn = cross(point.in_camera, along);
    const std::array<double, 6> gradient{turn.x, turn.y, turn.z, along.x, along.y, along.z};
    double sum = 0;
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j)
            sum += gradient[i] * point.placement[6 * i + j] * gradient[j];
    return std::max(sum, 0.0);
}

}  // namespace

MeasuredDistance distance_between(const MeasuredPoint& a, const MeasuredPoint& b) {
    const Vec3 step = b.room_from_camera * b.in_camera - a.room_from_camera * a.in_camera;
    const double reach = length(step);
    const Vec3 along = reach > 0 ? step * (1 / reach) : Vec3{0, 0, 1};
    double variance = 0;
    for (const MeasuredPoint* point : {&a, &b}) {
        const Vec3 in_camera = rotate(conjugate(point->room_from_camera.rotation), along);
        variance += noise_variance(*point, in_camera);
        if (a.camera != b.camera)
            variance += placement_variance(*point, in_camera);
    }
    return {reach, std::sqrt(variance)};
}

}  // namespace theatron::room
