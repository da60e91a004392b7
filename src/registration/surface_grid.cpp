// SPDX-License-Identifier: Apache-2.0
#include "registration/surface_grid.h"

#include <algorithm>
#include <cmath>

namespace theatron::registration {
namespace {

constexpr int reach = 4;  // pixels from the middle to the outer measurements
constexpr double least_cos = 0.34;
constexpr double least_normal_agreement = 0.8;  // of two cameras, cosine

}  // namespace

Size surface_grid_size(Size image) {
    return {image.width / surface_step, image.height / surface_step};
}

std::optional<SurfacePoint> surface_at(const SurfaceCamera& camera, DepthView depth, int x, int y) {
    if (x < reach || y < reach || x >= depth.size.width - reach || y >= depth.size.height - reach)
        return {};
    double z[3][3];
    Vec3 p[3][3];
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
            const int px = x + (i - 1) * reach, py = y + (j - 1) * reach;
            const std::uint16_t units = depth.row(py)[px];
            const Ray ray = camera.rays.view().row(py)[px];
            if (units == 0 || ray.x == no_ray)
                return {};
            const double measured = units * camera.depth_unit_mm / 1000;
            const DepthBias& b = camera.bias;
            z[j][i] = measured - (b.offset_m + b.per_x_m * ray.x + b.per_y_m * ray.y +
                                  b.per_m * (measured - DepthBias::reference_m));
            p[j][i] = {ray.x * z[j][i], ray.y * z[j][i], z[j][i]};
        }
    // Opposite measurements and the middle one lie on a line.
    const double tolerance = 2 * plane_tolerance_m(z[1][1]);
    for (const double bend :
         {z[1][0] + z[1][2], z[0][1] + z[2][1], z[0][0] + z[2][2], z[0][2] + z[2][0]})
        if (std::abs(bend - 2 * z[1][1]) > tolerance)
            return {};
    Vec3 mean{}, along_x{}, along_y{};
    for (int k = 0; k < 3; ++k) {
        along_x = along_x + p[k][2] - p[k][0];
        along_y = along_y + p[2][k] - p[0][k];
        mean = mean + (p[k][0] + p[k][1] + p[k][2]) * (1.0 / 9);
    }
    const Vec3 normal = normalized(cross(along_y, along_x));  // y is down: towards the camera
    if (-dot(normal, normalized(mean)) < least_cos)
        return {};
    return SurfacePoint{mean, normal};
}

std::vector<SurfacePoint> surface_grid(const SurfaceCamera& camera, DepthView depth) {
    const Size size = surface_grid_size(depth.size);
    std::vector<SurfacePoint> grid(size.area());
    for (int j = 0; j < size.height; ++j)
        for (int i = 0; i < size.width; ++i)
            if (const auto found = surface_at(camera, depth, i * surface_step + surface_step / 2,
                                              j * surface_step + surface_step / 2))
                grid[std::size_t(j * size.width + i)] = *found;
    return grid;
}

std::vector<OverlapPoint> overlap(const std::vector<SurfacePoint>& a, const SurfaceCamera& b,
                                  DepthView b_depth, const Pose& b_from_a, double farthest_m) {
    std::vector<OverlapPoint> points;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!a[i].is_valid())
            continue;
        const Vec3 at = b_from_a * a[i].at;
        const auto pixel = at.z > 0.1 ? project(b.model, at) : std::nullopt;
        if (!pixel || !(pixel->x > 0 && pixel->y > 0 && pixel->x < b.model.size.width &&
                        pixel->y < b.model.size.height))
            continue;
        const int x = int(pixel->x + 0.5), y = int(pixel->y + 0.5);
        if (x >= b_depth.size.width || y >= b_depth.size.height)
            continue;
        // Most points that camera b does not see are told by one measurement.
        const double there = b_depth.row(y)[x] * b.depth_unit_mm / 1000;
        if (std::abs(there - at.z) > 3 * farthest_m)
            continue;
        const auto surface = surface_at(b, b_depth, x, y);
        if (!surface ||
            dot(surface->normal, rotate(b_from_a.rotation, a[i].normal)) < least_normal_agreement)
            continue;
        const double apart = dot(surface->normal, at - surface->at);
        if (std::abs(apart) <= farthest_m)
            points.push_back({at, surface->normal, apart, int(i)});
    }
    return points;
}

double median_apart_m(const std::vector<OverlapPoint>& points) {
    if (points.empty())
        return 0;
    std::vector<double> apart;
    for (const OverlapPoint& point : points)
        apart.push_back(std::abs(point.apart_m));
    const auto middle = apart.begin() + long(apart.size() / 2);
    std::nth_element(apart.begin(), middle, apart.end());
    return *middle;
}

}  // namespace theatron::registration
