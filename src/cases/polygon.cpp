// SPDX-License-Identifier: Apache-2.0
#include "cases/polygon.h"

#include <cmath>

namespace theatron::cases {
namespace {

struct Point {
    double x = 0, y = 0;
};

// Twice the area of a triangle; positive if it turns left.
double area(Point a, Point b, Point c) {
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

// The polygon seen along the axis along which it is largest, so that it turns left.
std::vector<Point> flattened(std::span<const std::uint32_t> corners,
                             const std::vector<medical::Vec3f>& positions) {
    Vec3 normal{0, 0, 0};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 a = medical::to_double(positions[corners[i]]);
        const Vec3 b = medical::to_double(positions[corners[(i + 1) % corners.size()]]);
        normal = normal + Vec3{(a.y - b.y) * (a.z + b.z), (a.z - b.z) * (a.x + b.x),
                               (a.x - b.x) * (a.y + b.y)};
    }
    const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
    std::vector<Point> flat;
    for (const std::uint32_t corner : corners) {
        const Vec3 p = medical::to_double(positions[corner]);
        const Point seen = z >= x && z >= y ? Point{p.x, p.y}
                           : x >= y         ? Point{p.y, p.z}
                                            : Point{p.z, p.x};
        const double along = z >= x && z >= y ? normal.z : x >= y ? normal.x : normal.y;
        flat.push_back(along < 0 ? Point{seen.y, seen.x} : seen);
    }
    return flat;
}

}  // namespace

void add_polygon(std::span<const std::uint32_t> corners,
                 const std::vector<medical::Vec3f>& positions,
                 std::vector<medical::Triangle>& triangles) {
    if (corners.size() < 3)
        return;
    if (corners.size() == 3) {
        triangles.push_back({corners[0], corners[1], corners[2]});
        return;
    }
    const std::vector<Point> flat = flattened(corners, positions);
    std::vector<std::size_t> left(corners.size());
    for (std::size_t i = 0; i < left.size(); ++i)
        left[i] = i;
    // Ears are cut off until a triangle is left.
    const auto is_ear = [&](std::size_t at) {
        const std::size_t a = left[(at + left.size() - 1) % left.size()], b = left[at],
                          c = left[(at + 1) % left.size()];
        if (!(area(flat[a], flat[b], flat[c]) > 0))
            return false;
        for (const std::size_t other : left)
            if (other != a && other != b && other != c &&
                area(flat[a], flat[b], flat[other]) >= 0 &&
                area(flat[b], flat[c], flat[other]) >= 0 &&
                area(flat[c], flat[a], flat[other]) >= 0)
                return false;
        return true;
    };
    std::size_t at = 0;
    while (left.size() > 3) {
        std::size_t tried = 0;
        while (tried < left.size() && !is_ear(at)) {
            at = (at + 1) % left.size();
            ++tried;
        }
        // Any corner does where a polygon crosses itself.
        const std::size_t n = left.size();
        triangles.push_back(
            {corners[left[(at + n - 1) % n]], corners[left[at]], corners[left[(at + 1) % n]]});
        left.erase(left.begin() + std::ptrdiff_t(at));
        at = at % left.size();
    }
    triangles.push_back({corners[left[0]], corners[left[1]], corners[left[2]]});
}

}  // namespace theatron::cases
