// SPDX-License-Identifier: Apache-2.0
#include "compare_points.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace theatron::bench {
namespace {

// The picture's part of a square, and what it shows.
void draw_square(render::Picture& out, double x, double y, double edge_px, std::uint16_t mm,
                 Rgb color) {
    const Size size = out.color.size;
    const auto range = [&](double middle, int end) {
        const double from = middle - edge_px / 2;
        const int first = std::max(0, int(std::lround(from)));
        return std::pair{first,
                         std::min(end, std::max(first + 1, int(std::lround(from + edge_px))))};
    };
    const auto [left, right] = range(x, size.width);
    const auto [top, bottom] = range(y, size.height);
    for (int row = top; row < bottom; ++row)
        for (int column = left; column < right; ++column) {
            std::uint16_t& nearest = out.depth_mm.view().row(row)[column];
            if (nearest != 0 && nearest <= mm)
                continue;
            nearest = mm;
            out.color.view().row(row)[column] = color;
        }
}

}  // namespace

PointCloud cloud_of(const Calibration& calibration, const Image<Ray>& rays, DepthView depth,
                    ColorView color, View<const std::uint8_t> seen) {
    assert(rays.size == depth.size && color.size == depth.size && seen.size == depth.size);
    PointCloud cloud;
    for (int y = 0; y < depth.size.height; ++y)
        for (int x = 0; x < depth.size.width; ++x) {
            const double z = depth_m(calibration, depth.row(y)[x]);
            const Ray ray = rays.view().row(y)[x];
            if (z <= 0 || ray.x == no_ray || seen.row(y)[x] == 0)
                continue;
            const Rgb c = color.row(y)[x];
            cloud.push_back({float(ray.x * z), float(ray.y * z), float(z), c.r, c.g, c.b, 0});
        }
    return cloud;
}

render::Picture draw_points(const std::vector<PlacedCloud>& clouds, const render::CameraView& view,
                            Size size, double edge_m) {
    render::Picture picture{ColorImage(size), DepthImage(size)};
    std::fill(picture.color.pixels.begin(), picture.color.pixels.end(), render::cloud_background);
    const double per_tangent_x = size.width / (view.right - view.left);
    const double per_tangent_y = size.height / (view.bottom - view.top);
    const Pose eye_from_room = inverse(view.room_from_eye);
    for (const PlacedCloud& placed : clouds) {
        const Pose eye_from_camera = eye_from_room * placed.room_from_camera;
        for (const ColorPoint& point : *placed.cloud) {
            const Vec3 p = eye_from_camera * Vec3{point.x, point.y, point.z};
            if (!(p.z > view.near_m && p.z < 65))
                continue;
            const double x = (p.x / p.z - view.left) * per_tangent_x;
            const double y = (p.y / p.z - view.top) * per_tangent_y;
            const double edge = std::max(1.0, edge_m / p.z * per_tangent_x);
            if (x < -edge || y < -edge || x > size.width + edge || y > size.height + edge)
                continue;
            draw_square(picture, x, y, edge, std::uint16_t(std::lround(p.z * 1000)),
                        {point.r, point.g, point.b});
        }
    }
    return picture;
}

}  // namespace theatron::bench
