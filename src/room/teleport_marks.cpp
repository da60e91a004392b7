// SPDX-License-Identifier: Apache-2.0
#include "room/teleport_marks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace theatron::room {
namespace {

constexpr int ball_rings = 6;
constexpr double ball_radius_m = 0.018;
constexpr int balls_every = 3;  // points of the arc
constexpr double ring_radius_m = 0.28, ring_width_m = 0.05, ring_height_m = 0.01;
constexpr int ring_corners = 40;
constexpr int particles = 18;
constexpr double spiral_radius_m = 0.3, spiral_turns = 1.5;
const Vec3 no_landing_color{0.5, 0.05, 0.03};

// A flat ring around the origin that is seen from above.
render::MeshData ring_mesh() {
    render::MeshData mesh;
    for (int i = 0; i < ring_corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / ring_corners;
        for (const double radius : {ring_radius_m, ring_radius_m - ring_width_m})
            mesh.vertices.push_back(
                {float(radius * std::cos(angle)), 0, float(radius * std::sin(angle)), 0, 1, 0});
        const auto a = std::uint32_t(2 * i), b = std::uint32_t(2 * ((i + 1) % ring_corners));
        for (const std::uint32_t corner : {a, a + 1, b, b, a + 1, b + 1})
            mesh.indices.push_back(corner);
    }
    return mesh;
}

render::SurfaceLook glowing(Vec3 color, double opacity = 1) {
    render::SurfaceLook look{color, 0, 1, opacity, 0};
    look.unlit = true;
    return look;
}

}  // namespace

TeleportMarks::TeleportMarks()
    : ball_(render::make_sphere_mesh(ball_radius_m, ball_rings)), ring_(ring_mesh()) {}

void TeleportMarks::add_arc(render::SceneFrame& frame, const TeleportArc& arc, Vec3 color) const {
    const render::SurfaceLook look = glowing(arc.landing ? color : no_landing_color);
    for (std::size_t i = balls_every; i < arc.points.size(); i += balls_every)
        frame.objects.push_back({&ball_, {{}, arc.points[i]}, look});
    if (arc.landing)
        frame.objects.push_back({&ring_, {{}, *arc.landing + Vec3{0, ring_height_m, 0}}, look});
}

void TeleportMarks::add_effect(render::SceneFrame& frame, Vec3 head, Vec3 color,
                               double age_s) const {
    const double share = std::clamp(age_s / effect_s, 0.0, 1.0);
    for (int i = 0; i < particles; ++i) {
        const double own = double(i) / particles;
        const double angle = 2 * std::numbers::pi * (own * 3 + spiral_turns * share);
        const double radius = spiral_radius_m * (1 - 0.5 * share);
        const double height = head.y * std::min(1.0, share * (0.4 + 0.8 * own));
        const Vec3 place{head.x + radius * std::cos(angle), height,
                         head.z + radius * std::sin(angle)};
        frame.objects.push_back({&ball_, {{}, place}, glowing(color, 1 - share)});
    }
}

}  // namespace theatron::room
