// SPDX-License-Identifier: Apache-2.0
#include "geometry/camera_model.h"

#include <numbers>

namespace theatron {
namespace {

// Distorts a direction by OpenCV's rational model.
Vec2 distort(const CameraModel& c, Vec2 d) {
    const double r2 = d.x * d.x + d.y * d.y;
    const double numerator = 1 + r2 * (c.k[0] + r2 * (c.k[1] + r2 * c.k[2]));
    const double denominator = 1 + r2 * (c.k[3] + r2 * (c.k[4] + r2 * c.k[5]));
    const double radial = denominator != 0 ? numerator / denominator : 1;
    const double xy2 = 2 * d.x * d.y;
    return {d.x * radial + c.p1 * xy2 + c.p2 * (r2 + 2 * d.x * d.x),
            d.y * radial + c.p2 * xy2 + c.p1 * (r2 + 2 * d.y * d.y)};
}

bool beyond_radius(const CameraModel& c, Vec2 d) {
    return c.max_radius > 0 && d.x * d.x + d.y * d.y > c.max_radius * c.max_radius;
}

}  // namespace

CameraModel pinhole(Size size, double horizontal_fov_degrees) {
    CameraModel camera;
    camera.size = size;
    camera.fx = size.width / 2.0 / std::tan(horizontal_fov_degrees * std::numbers::pi / 360);
    camera.fy = camera.fx;
    camera.cx = (size.width - 1) / 2.0;
    camera.cy = (size.height - 1) / 2.0;
    return camera;
}

std::optional<Vec2> project(const CameraModel& camera, Vec3 point) {
    if (!(point.z > 0))
        return std::nullopt;
    const Vec2 direction{point.x / point.z, point.y / point.z};
    if (beyond_radius(camera, direction))
        return std::nullopt;
    const Vec2 d = distort(camera, direction);
    return Vec2{d.x * camera.fx + camera.cx, d.y * camera.fy + camera.cy};
}

std::optional<Vec2> unproject(const CameraModel& camera, Vec2 pixel) {
    const Vec2 target{(pixel.x - camera.cx) / camera.fx, (pixel.y - camera.cy) / camera.fy};
    Vec2 d = target;
    for (int i = 0; i < 20; ++i) {
        const Vec2 f = distort(camera, d);
        const Vec2 error{f.x - target.x, f.y - target.y};
        if (error.x * error.x + error.y * error.y < 1e-20)
            return beyond_radius(camera, d) ? std::nullopt : std::optional(d);
        // Central differences are accurate enough for quadratic convergence.
        constexpr double h = 1e-6;
        const Vec2 right = distort(camera, {d.x + h, d.y}), left = distort(camera, {d.x - h, d.y});
        const Vec2 below = distort(camera, {d.x, d.y + h}), above = distort(camera, {d.x, d.y - h});
        const double a = (right.x - left.x) / (2 * h), b = (below.x - above.x) / (2 * h);
        const double c = (right.y - left.y) / (2 * h), e = (below.y - above.y) / (2 * h);
        const double determinant = a * e - b * c;
        if (!(std::abs(determinant) > 1e-9))
            return std::nullopt;
        d.x -= (e * error.x - b * error.y) / determinant;
        d.y -= (a * error.y - c * error.x) / determinant;
    }
    return std::nullopt;
}

CameraModel scaled(const CameraModel& camera, Size size) {
    const double sx = double(size.width) / camera.size.width;
    const double sy = double(size.height) / camera.size.height;
    CameraModel result = camera;
    result.size = size;
    result.fx *= sx;
    result.fy *= sy;
    // Pixel centres are whole numbers, so the image's edge lies at -0.5.
    result.cx = (camera.cx + 0.5) * sx - 0.5;
    result.cy = (camera.cy + 0.5) * sy - 0.5;
    return result;
}

}  // namespace theatron
