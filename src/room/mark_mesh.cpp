// SPDX-License-Identifier: Apache-2.0
#include "room/mark_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "room/mesh_parts.h"

namespace theatron::room {

using session::Mark;
using session::MarkKind;
using session::MarkPoint;

namespace {

constexpr double tube_radius_m = 0.0016;
constexpr double ball_radius_m = 0.004;
constexpr double cone_length_m = 0.014, cone_radius_m = 0.005;
constexpr double pin_height_m = 0.03, pin_radius_m = 0.005, pin_foot_m = 0.0006;
constexpr int sides = 8;

Vec3 perpendicular(Vec3 v) {
    return normalized(cross(v, std::abs(v.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
}

struct Ring {
    Vec3 middle, along;  // `along` of length 1
    double radius = 0;
};

// A closed tube through rings; ends of radius 0 are points.
void add_tube(render::MeshData& mesh, const std::vector<Ring>& rings) {
    const auto add = [&](Vec3 p, Vec3 n) {
        mesh.vertices.push_back(
            {float(p.x), float(p.y), float(p.z), float(n.x), float(n.y), float(n.z)});
        return std::uint32_t(mesh.vertices.size() - 1);
    };
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
    };
    Vec3 u = perpendicular(rings.front().along);
    std::uint32_t before = 0;
    for (std::size_t r = 0; r < rings.size(); ++r) {
        const Ring& ring = rings[r];
        // Carried along with as little turning as possible.
        const Vec3 across = u - ring.along * dot(u, ring.along);
        u = length(across) > 1e-3 ? normalized(across) : perpendicular(ring.along);
        const Vec3 v = cross(ring.along, u);
        const auto first = std::uint32_t(mesh.vertices.size());
        for (int i = 0; i < sides; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            const Vec3 out = u * std::cos(angle) + v * std::sin(angle);
            add(ring.middle + out * ring.radius, out);
        }
        for (std::uint32_t i = 0; r > 0 && i < sides; ++i) {
            const std::uint32_t j = (i + 1) % sides;
            triangle(before + i, before + j, first + j);
            triangle(before + i, first + j, first + i);
        }
        before = first;
    }
    const auto cap = [&](const Ring& ring, std::uint32_t first, bool at_end) {
        const std::uint32_t middle = add(ring.middle, at_end ? ring.along : -ring.along);
        for (std::uint32_t i = 0; i < sides; ++i) {
            const std::uint32_t j = (i + 1) % sides;
            at_end ? triangle(middle, first + i, first + j)
                   : triangle(middle, first + j, first + i);
        }
    };
    cap(rings.front(), before - std::uint32_t(rings.size() - 1) * sides, false);
    cap(rings.back(), before, true);
}

Vec3 direction(Vec3 from, Vec3 to, Vec3 otherwise) {
    const Vec3 step = to - from;
    const double l = length(step);
    return l > 1e-6 ? step * (1 / l) : otherwise;
}

// The middle line of a tube that lies on the surface.
std::vector<Ring> line_on_surface(const std::vector<MarkPoint>& points) {
    std::vector<Ring> rings;
    Vec3 along = perpendicular(points[0].normal);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, points.size() - 1);
        along = direction(points[before].position, points[after].position, along);
        rings.push_back(
            {points[i].position + points[i].normal * tube_radius_m, along, tube_radius_m});
    }
    return rings;
}

void add_ball(render::MeshData& mesh, Vec3 place, double radius) {
    append(mesh, render::make_sphere_mesh(radius, 8), {1, 1, 1}, place);
}

void add_arrow(render::MeshData& mesh, const MarkPoint& tail, const MarkPoint& tip) {
    const Vec3 along = direction(tail.position, tip.position, -tip.normal);
    const double reach = length(tip.position - tail.position);
    const double head = std::min(cone_length_m, 0.7 * reach);
    const Vec3 neck = tip.position - along * head;
    if (reach > 1e-6)
        add_tube(mesh, {{tail.position, along, tube_radius_m}, {neck, along, tube_radius_m}});
    add_tube(mesh, {{neck, along, cone_radius_m}, {tip.position, along, 0}});
}

}  // namespace

render::MeshData make_mark_mesh(const Mark& mark) {
    render::MeshData mesh;
    const std::vector<MarkPoint>& points = mark.points;
    switch (mark.kind) {
        case MarkKind::stroke:
            add_tube(mesh, line_on_surface(points));
            break;
        case MarkKind::arrow:
            add_arrow(mesh, points[0], points[1]);
            break;
        case MarkKind::pin: {
            const Vec3 up = normalized(points[0].normal);
            const Vec3 head = points[0].position + up * pin_height_m;
            add_tube(mesh, {{points[0].position, up, pin_foot_m}, {head, up, 2 * pin_foot_m}});
            add_ball(mesh, head, pin_radius_m);
            break;
        }
        case MarkKind::distance:
            // Straight through the air or the organ: the length that is measured.
            add_tube(mesh, {{points[0].position,
                             direction(points[0].position, points[1].position, points[0].normal),
                             tube_radius_m},
                            {points[1].position,
                             direction(points[0].position, points[1].position, points[0].normal),
                             tube_radius_m}});
            for (const MarkPoint& point : points)
                add_ball(mesh, point.position, ball_radius_m);
            break;
    }
    return mesh;
}

std::string label_of(const Mark& mark) {
    if (mark.kind == MarkKind::pin)
        return std::to_string(mark.number) + " " + mark.initials;
    if (mark.kind != MarkKind::distance)
        return mark.initials;
    const double mm = 1000 * length(mark.points[1].position - mark.points[0].position);
    char text[64];
    if (mark.deviation_m > 0)
        std::snprintf(text, sizeof(text), "%.1f mm \u00b1 %.1f mm ", mm,
                      2000 * double(mark.deviation_m));
    else
        std::snprintf(text, sizeof(text), "%.1f mm ", mm);
    return text + mark.initials;
}

Vec3 label_place(const Mark& mark) {
    const MarkPoint& last = mark.points.back();
    if (mark.kind == MarkKind::pin)
        return last.position + last.normal * (pin_height_m + 2 * pin_radius_m);
    const Vec3 place = mark.kind == MarkKind::distance
                           ? (mark.points[0].position + last.position) * 0.5
                           : last.position;
    return place + last.normal * (4 * ball_radius_m);
}

}  // namespace theatron::room
