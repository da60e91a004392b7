// SPDX-License-Identifier: Apache-2.0
#include "registration/room_alignment.h"

#include <cmath>

namespace theatron::registration {
namespace {

constexpr int step = 4;  // of pixels
constexpr double least_below_m = 0.5, least_area_m2 = 0.3;
constexpr double radius_m = 1.5;
constexpr double cos_tilt = 0.5;
constexpr double cos_level = 0.996;  // five degrees
constexpr double lowest_table_m = 0.55, highest_table_m = 1.25;
constexpr double usual_height_m = 1.5;

std::vector<FoundPlane> large_planes(DepthView depth, double depth_unit_mm,
                                     const Image<Ray>& rays) {
    Image<Ray> fewer({depth.size.width / step, depth.size.height / step});
    SparseDepth sparse;
    sparse.size = fewer.size;
    sparse.rays = &fewer;
    for (int y = 0; y < fewer.size.height; ++y)
        for (int x = 0; x < fewer.size.width; ++x) {
            const Ray ray = rays.view().row(y * step)[x * step];
            const std::uint16_t units = depth.row(y * step)[x * step];
            fewer.view().row(y)[x] = ray;
            sparse.inverse_m.push_back(
                units == 0 || ray.x == no_ray ? 0 : float(1000 / (units * depth_unit_mm)));
        }
    std::vector<std::uint8_t> explained;
    return find_planes(sparse, {radius_m, least_area_m2, 1e6}, explained);
}

}  // namespace

std::optional<FoundPlane> find_floor(DepthView depth, double depth_unit_mm,
                                     const Image<Ray>& rays) {
    std::optional<FoundPlane> floor;
    for (const FoundPlane& found : large_planes(depth, depth_unit_mm, rays)) {
        const bool is_level = -found.plane.normal().y > cos_tilt;
        const double below = found.plane.distance_m();
        if (is_level && below > least_below_m && (!floor || below > floor->plane.distance_m()))
            floor = found;
    }
    return floor;
}

std::optional<FoundPlane> find_table(DepthView depth, double depth_unit_mm, const Image<Ray>& rays,
                                     const Plane& floor) {
    std::optional<FoundPlane> table;
    for (const FoundPlane& found : large_planes(depth, depth_unit_mm, rays)) {
        const double height = floor.distance_m() + dot(found.middle, floor.normal());
        if (dot(found.plane.normal(), floor.normal()) > cos_level && height > lowest_table_m &&
            height < highest_table_m && (!table || found.area_m2 > table->area_m2))
            table = found;
    }
    return table;
}

Pose room_from_reference(const std::optional<Plane>& floor, Vec3 middle) {
    const Vec3 up = floor ? floor->normal() : Vec3{0, -1, 0};
    const double height = floor ? floor->distance_m() : usual_height_m;
    // Where the camera looks, or where its picture's upper edge is if it looks straight down.
    const Vec3 ahead{0, 0, 1}, above{0, -1, 0};
    Vec3 forward = ahead - up * dot(up, ahead);
    if (length(forward) < 0.1)
        forward = above - up * dot(up, above);
    const Vec3 z = -normalized(forward), x = cross(up, z);
    const Quat rotation =
        quat_from_matrix({{{x.x, x.y, x.z}, {up.x, up.y, up.z}, {z.x, z.y, z.z}}});
    const Vec3 origin = middle - up * (dot(up, middle) + height);
    return {rotation, -rotate(rotation, origin)};
}

}  // namespace theatron::registration
