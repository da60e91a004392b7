// SPDX-License-Identifier: Apache-2.0
#include "geometry/ply.h"

#include <cassert>
#include <cmath>
#include <string>

#include "base/float_bytes.h"

namespace theatron {
namespace {

Rgb color_of(Vec3 point, ColorView color, const Calibration& calibration) {
    if (color.size == Size{})
        return unseen_color;
    const auto pixel = project(calibration.color, calibration.color_from_depth * point);
    if (!pixel)
        return unseen_color;
    // Compared before conversion: values far outside do not fit an int.
    const double x = std::floor(pixel->x + 0.5), y = std::floor(pixel->y + 0.5);
    if (!(x >= 0 && x < color.size.width && y >= 0 && y < color.size.height))
        return unseen_color;
    return color.row(int(y))[int(x)];
}

}  // namespace

void append_points(DepthView depth, const Image<Ray>& rays, ColorView color,
                   const Calibration& calibration, std::vector<ColoredPoint>& out) {
    assert(depth.size == rays.size);
    for (int y = 0; y < depth.size.height; ++y) {
        const std::uint16_t* row = depth.row(y);
        const Ray* ray_row = rays.view().row(y);
        for (int x = 0; x < depth.size.width; ++x) {
            const double z = depth_m(calibration, row[x]);
            if (z == 0 || ray_row[x].x == no_ray)
                continue;
            const Vec3 point{ray_row[x].x * z, ray_row[x].y * z, z};
            out.push_back({float(point.x), float(point.y), float(point.z),
                           color_of(point, color, calibration)});
        }
    }
}

void transform_points(const Pose& a_from_b, std::span<ColoredPoint> points) {
    for (ColoredPoint& p : points) {
        const Vec3 moved = a_from_b * Vec3{p.x, p.y, p.z};
        p.x = float(moved.x);
        p.y = float(moved.y);
        p.z = float(moved.z);
    }
}

Bytes encode_ply(std::span<const ColoredPoint> points, std::span<const std::string> comments) {
    std::string header = "ply\nformat binary_little_endian 1.0\n";
    for (const std::string& comment : comments)
        if (!comment.empty())
            header += "comment " + comment + "\n";
    header += "element vertex " + std::to_string(points.size()) +
              "\nproperty float x\nproperty float y\nproperty float z\n"
              "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
    const ByteView text = as_bytes(header);
    Bytes bytes(text.begin(), text.end());
    constexpr std::size_t point_size = 15;
    bytes.resize(text.size() + points.size() * point_size);
    std::byte* at = bytes.data() + text.size();
    for (const ColoredPoint& p : points) {
        store_f32(at, p.x);
        store_f32(at + 4, p.y);
        store_f32(at + 8, p.z);
        at[12] = std::byte(p.color.r);
        at[13] = std::byte(p.color.g);
        at[14] = std::byte(p.color.b);
        at += point_size;
    }
    return bytes;
}

}  // namespace theatron
