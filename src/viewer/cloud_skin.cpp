// SPDX-License-Identifier: Apache-2.0
#include "viewer/cloud_skin.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/ply.h"
#include "image/image.h"
#include "image/srgb.h"

namespace theatron::viewer {
namespace {

// One pixel of this number is looked at, both ways.
constexpr int skin_step = 4;
constexpr std::size_t least_points = 40;
// The neck, in the person's frame: between the eyes is the origin, y up, -z forward.
constexpr double neck_side_m = 0.08, neck_low_m = -0.24, neck_high_m = -0.12, neck_front_m = -0.06,
                 neck_back_m = 0.14;
// Skin of every kind is redder than it is green, and greener than it is blue.
constexpr int least_redder = 12;
constexpr double least_gain = 0.5, most_gain = 2;

bool is_neck(Vec3 p) {
    return std::abs(p.x) < neck_side_m && p.y > neck_low_m && p.y < neck_high_m &&
           p.z > neck_front_m && p.z < neck_back_m;
}

bool is_like_skin(Rgb color) {
    return color.r > color.g && color.g >= color.b && color.r >= color.b + least_redder;
}

}  // namespace

std::optional<Vec3> cloud_skin(DepthView depth, ColorView color, const Calibration& calibration,
                               const Image<Ray>& rays) {
    if (color.size.area() == 0 || depth.size != rays.size)
        return std::nullopt;
    DepthImage sparse(depth.size);
    for (int y = 0; y < depth.size.height; y += skin_step)
        for (int x = 0; x < depth.size.width; x += skin_step)
            sparse.view().row(y)[x] = depth.row(y)[x];
    std::vector<ColoredPoint> points;
    append_points(sparse.view(), rays, color, calibration, points);
    Vec3 sum;
    std::size_t count = 0;
    for (const ColoredPoint& point : points) {
        const Vec3 in_camera{point.x, point.y, point.z};
        const Rgb seen = point.color;
        if (!is_like_skin(seen) || !is_neck(calibration.room_from_camera * in_camera))
            continue;
        sum = sum + Vec3{srgb_to_linear(seen.r / 255.0), srgb_to_linear(seen.g / 255.0),
                         srgb_to_linear(seen.b / 255.0)};
        ++count;
    }
    if (count < least_points)
        return std::nullopt;
    return sum * (1 / double(count));
}

Vec3 skin_gain(Vec3 face_skin, Vec3 cloud_skin) {
    const auto gain = [](double from, double to) {
        return from > 0 ? std::clamp(to / from, least_gain, most_gain) : 1;
    };
    return {gain(face_skin.x, cloud_skin.x), gain(face_skin.y, cloud_skin.y),
            gain(face_skin.z, cloud_skin.z)};
}

}  // namespace theatron::viewer
