// SPDX-License-Identifier: Apache-2.0
#include "render/triangle_tree.h"

#include <algorithm>
#include <array>
#include <limits>

namespace theatron::render {
namespace {

constexpr std::uint32_t leaf_size = 4;  // triangles

Vec3 lower(Vec3 a, Vec3 b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3 upper(Vec3 a, Vec3 b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

double along(Vec3 v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// True if the ray meets the box before `limit`. Infinite quotients compare correctly.
bool meets(Vec3 low, Vec3 high, Vec3 from, Vec3 direction, double limit) {
    double enter = 0, leave = limit;
    for (int axis = 0; axis < 3; ++axis) {
        const double d = along(direction, axis), o = along(from, axis);
        if (d == 0) {
            if (o < along(low, axis) || o > along(high, axis))
                return false;
            continue;
        }
        const double t1 = (along(low, axis) - o) / d, t2 = (along(high, axis) - o) / d;
        enter = std::max(enter, std::min(t1, t2));
        leave = std::min(leave, std::max(t1, t2));
    }
    return enter <= leave;
}

std::optional<double> distance_to(const TriangleTree::Triangle& t, Vec3 from, Vec3 direction) {
    const Vec3 ab = t.b - t.a, ac = t.c - t.a, p = cross(direction, ac);
    const double determinant = dot(ab, p);
    if (determinant == 0)
        return std::nullopt;
    const Vec3 s = from - t.a;
    const double u = dot(s, p) / determinant;
    const Vec3 q = cross(s, ab);
    const double v = dot(direction, q) / determinant;
    const double distance = dot(ac, q) / determinant;
    if (u < 0 || v < 0 || u + v > 1 || distance <= 0)
        return std::nullopt;
    return distance;
}

}  // namespace

TriangleTree::TriangleTree(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
    if (!triangles_.empty())
        build(0, std::uint32_t(triangles_.size()));
}

void TriangleTree::build(std::uint32_t first, std::uint32_t count) {
    const auto begin = triangles_.begin() + first, end = begin + count;
    Node node{begin->a, begin->a, first, count, 0};
    for (auto t = begin; t != end; ++t)
        for (const Vec3 corner : {t->a, t->b, t->c}) {
            node.low = lower(node.low, corner);
            node.high = upper(node.high, corner);
        }
    const std::size_t here = nodes_.size();
    nodes_.push_back(node);
    if (count <= leaf_size)
        return;
    const Vec3 size = node.high - node.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t half = count / 2;
    std::nth_element(begin, begin + half, end, [&](const Triangle& l, const Triangle& r) {
        return along(l.a + l.b + l.c, axis) < along(r.a + r.b + r.c, axis);
    });
    build(first, half);
    nodes_[here].second = std::uint32_t(nodes_.size());
    build(first + half, count - half);
}

std::optional<TriangleTree::Hit> TriangleTree::nearest(Vec3 from, Vec3 direction) const {
    if (nodes_.empty())
        return std::nullopt;
    double best = std::numeric_limits<double>::infinity();
    const Triangle* found = nullptr;
    // Halving 2^32 triangles takes 32 levels, and a level leaves one node behind.
    std::array<std::uint32_t, 40> waiting;
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
        const std::uint32_t at = waiting[--count];
        const Node& node = nodes_[at];
        if (!meets(node.low, node.high, from, direction, best))
            continue;
        if (node.second != 0) {
            waiting[count++] = node.second;
            waiting[count++] = at + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
            if (const auto distance = distance_to(triangles_[i], from, direction);
                distance && *distance < best) {
                best = *distance;
                found = &triangles_[i];
            }
    }
    if (!found)
        return std::nullopt;
    return Hit{best, normalized(cross(found->b - found->a, found->c - found->a))};
}

}  // namespace theatron::render
