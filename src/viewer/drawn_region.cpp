// SPDX-License-Identifier: Apache-2.0
#include "viewer/drawn_region.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/ray_table.h"

namespace theatron::viewer {
namespace {

// The surface in front is found in cells of the rectangle, larger than the gaps between points.
constexpr int cells = 48;
// Points this far behind the nearest one of their cell are another surface.
constexpr double behind_m = 0.1, behind_share = 0.05;

struct RegionSight {
    int x = 0, y = 0;  // of the depth picture
    int cell = 0;
    double distance_m = 0;
};

}  // namespace

std::optional<session::PictureBox> drawn_region(const ViewRectangle& rectangle,
                                                const render::CameraView& view,
                                                const CloudCamera& camera) {
    const Calibration& calibration = *camera.calibration;
    if (camera.depth.size != calibration.depth.size)
        return std::nullopt;
    const double left = std::min(rectangle.from.x, rectangle.to.x),
                 right = std::max(rectangle.from.x, rectangle.to.x),
                 top = std::min(rectangle.from.y, rectangle.to.y),
                 bottom = std::max(rectangle.from.y, rectangle.to.y);
    if (!(right > left) || !(bottom > top))
        return std::nullopt;
    const auto rays = make_ray_table(calibration.depth);
    const Pose eye_from_camera = inverse(view.room_from_eye) * calibration.room_from_camera;
    std::vector<RegionSight> seen;
    std::vector<double> nearest(std::size_t(cells * cells), view.far_m);
    for (int y = 0; y < camera.depth.size.height; ++y)
        for (int x = 0; x < camera.depth.size.width; ++x) {
            const double z = depth_m(calibration, camera.depth.row(y)[x]);
            const Ray ray =
                rays.pixels[std::size_t(y) * std::size_t(camera.depth.size.width) + std::size_t(x)];
            if (!(z > 0) || ray.x == no_ray)
                continue;
            const Vec3 at = eye_from_camera * Vec3{ray.x * z, ray.y * z, z};
            if (at.z < view.near_m)
                continue;
            const double across = (at.x / at.z - view.left) / (view.right - view.left),
                         down = (at.y / at.z - view.top) / (view.bottom - view.top);
            if (across < left || across >= right || down < top || down >= bottom)
                continue;
            const int column = std::min(int((across - left) / (right - left) * cells), cells - 1),
                      row = std::min(int((down - top) / (bottom - top) * cells), cells - 1);
            const int cell = row * cells + column;
            seen.push_back({x, y, cell, at.z});
            nearest[std::size_t(cell)] = std::min(nearest[std::size_t(cell)], at.z);
        }
    int count = 0, x0 = camera.depth.size.width, y0 = camera.depth.size.height, x1 = 0, y1 = 0;
    for (const RegionSight& point : seen) {
        const double front = nearest[std::size_t(point.cell)];
        if (point.distance_m > front + std::max(behind_m, behind_share * front))
            continue;
        ++count;
        x0 = std::min(x0, point.x);
        y0 = std::min(y0, point.y);
        x1 = std::max(x1, point.x + 1);
        y1 = std::max(y1, point.y + 1);
    }
    if (count < least_region_pixels)
        return std::nullopt;
    return session::PictureBox{x0, y0, x1 - x0, y1 - y0};
}

}  // namespace theatron::viewer
