// SPDX-License-Identifier: Apache-2.0
#include "room/figure_meshes.h"

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "room/mesh_parts.h"

namespace theatron::room {
namespace {

using render::MeshData;

constexpr double pi = std::numbers::pi;
constexpr int segments = 24, small_rings = 7;

// A horizontal ellipse of a surface: its height, its radii to the side and to the front, and how
// far behind the axis its middle is.
struct Ring {
    double y, side, front, back = 0;
};

MeshData::Vertex vertex(Vec3 place, Vec3 normal) {
    return {float(place.x),  float(place.y),  float(place.z),
            float(normal.x), float(normal.y), float(normal.z)};
}

// `angle`: 0 to the front, a right angle to the person's right.
Vec3 on_ring(const Ring& ring, double angle) {
    return {ring.side * std::sin(angle), ring.y, ring.back - ring.front * std::cos(angle)};
}

// The surface through all rings, which are listed upwards, between two angles.
MeshData loft(std::span<const Ring> rings, double from = 0, double to = 2 * pi) {
    MeshData mesh;
    for (std::size_t i = 0; i < rings.size(); ++i)
        for (int s = 0; s <= segments; ++s) {
            const double angle = from + (to - from) * s / segments;
            const Ring& below = rings[i == 0 ? 0 : i - 1];
            const Ring& above = rings[i + 1 == rings.size() ? i : i + 1];
            const Vec3 up = on_ring(above, angle) - on_ring(below, angle);
            const Vec3 around{rings[i].side * std::cos(angle), 0, rings[i].front * std::sin(angle)};
            const Vec3 normal = cross(up, around);
            const bool is_point = length(around) < 1e-6;
            mesh.vertices.push_back(
                vertex(on_ring(rings[i], angle),
                       is_point ? Vec3{0, i == 0 ? -1.0 : 1.0, 0} : normalized(normal)));
        }
    for (std::uint32_t i = 0; i + 1 < rings.size(); ++i)
        for (std::uint32_t s = 0; s < segments; ++s) {
            const std::uint32_t low = i * (segments + 1) + s, high = low + segments + 1;
            mesh.indices.insert(mesh.indices.end(), {low, high, low + 1, low + 1, high, high + 1});
        }
    return mesh;
}

// A part that is scaled along its axes, turned and moved.
void append_turned(MeshData& mesh, const MeshData& part, Vec3 scale, const Pose& place) {
    MeshData scaled;
    append(scaled, part, scale, {});
    const auto first = std::uint32_t(mesh.vertices.size());
    for (const MeshData::Vertex& v : scaled.vertices)
        mesh.vertices.push_back(
            vertex(place * Vec3{v.px, v.py, v.pz}, rotate(place.rotation, {v.nx, v.ny, v.nz})));
    for (const std::uint32_t i : scaled.indices)
        mesh.indices.push_back(first + i);
}

// A finger of this length from its root on, bent downwards by an angle and outwards by another one.
void append_finger(MeshData& mesh, Vec3 root, double length_m, double bent, double outwards) {
    static const MeshData ball = render::make_sphere_mesh(1, small_rings);
    constexpr double radius_m = 0.0095;
    const Quat turn = rotation_about({0, 1, 0}, -outwards) * rotation_about({1, 0, 0}, -bent);
    const Vec3 middle = root + rotate(turn, {0, 0, -length_m / 2});
    append_turned(mesh, ball, {radius_m, radius_m, length_m / 2 + radius_m}, {turn, middle});
}

}  // namespace

render::MeshData back_mesh(const BackSizes& half_widths, double below) {
    // How far back each ring reaches from where it begins, behind the edges of the face.
    constexpr BackSizes reach{0.04, 0.058, 0.08, 0.09, 0.094, 0.092},
        begin{0, 0.008, 0.012, 0.012, 0.012, 0.012};
    std::array<Ring, back_heights.size()> rings;
    for (std::size_t i = 0; i < rings.size(); ++i)
        rings[i] = {back_heights[i], half_widths[i], reach[i], begin[i]};
    return loft(rings, 0.5 * pi - below, 1.5 * pi + below);
}

BustMeshes bust_meshes() {
    constexpr Ring head[] = {{-0.128, 0, 0, -0.03},          {-0.122, 0.026, 0.028, -0.028},
                             {-0.105, 0.044, 0.052, -0.018}, {-0.07, 0.06, 0.074, -0.002},
                             {-0.03, 0.07, 0.088, 0.008},    {0.01, 0.074, 0.094, 0.012},
                             {0.06, 0.075, 0.095, 0.014}};
    constexpr Ring neck[] = {
        {-0.24, 0.058, 0.056, 0.035}, {-0.17, 0.053, 0.053, 0.032}, {-0.07, 0.052, 0.055, 0.03}};
    constexpr Ring cap[] = {{0.028, 0.077, 0.097, 0.014}, {0.032, 0.084, 0.104, 0.014},
                            {0.06, 0.086, 0.106, 0.015},  {0.09, 0.079, 0.098, 0.017},
                            {0.115, 0.06, 0.077, 0.018},  {0.13, 0.034, 0.045, 0.019},
                            {0.135, 0, 0, 0.019}};
    constexpr Ring mask[] = {{-0.13, 0.02, 0.022, -0.03},    {-0.118, 0.04, 0.046, -0.024},
                             {-0.095, 0.056, 0.07, -0.014},  {-0.062, 0.068, 0.09, 0},
                             {-0.036, 0.0735, 0.097, 0.008}, {-0.022, 0.0735, 0.0955, 0.01}};
    constexpr Ring gown[] = {{-0.47, 0, 0, 0.03},          {-0.462, 0.1, 0.055, 0.03},
                             {-0.435, 0.152, 0.085, 0.03}, {-0.385, 0.18, 0.1, 0.03},
                             {-0.33, 0.196, 0.104, 0.03},  {-0.285, 0.197, 0.098, 0.03},
                             {-0.25, 0.176, 0.089, 0.03},  {-0.222, 0.132, 0.08, 0.03},
                             {-0.2, 0.09, 0.072, 0.031},   {-0.18, 0.068, 0.066, 0.032}};
    constexpr Ring collar[] = {{-0.197, 0.086, 0.076, 0.031},
                               {-0.186, 0.076, 0.073, 0.032},
                               {-0.166, 0.066, 0.067, 0.032},
                               {-0.162, 0.056, 0.058, 0.032}};
    BustMeshes meshes{loft(head), back_mesh(usual_back_widths),
                      loft(cap),  loft(mask, -0.44 * pi, 0.44 * pi),
                      {},         loft(neck),
                      loft(gown), loft(collar)};
    const MeshData ball = render::make_sphere_mesh(1, small_rings);
    for (const double side : {-1.0, 1.0})
        append(meshes.eyes, ball, {0.0125, 0.0065, 0.006}, {side * 0.031, 0.001, -0.074});
    return meshes;
}

HandMeshes hand_meshes(Side side, bool points) {
    const MeshData ball = render::make_sphere_mesh(1, small_rings);
    // The thumb of the right hand, seen from above with the fingers ahead, is on the left.
    const double inwards = side == Side::right ? -1 : 1;
    HandMeshes meshes;
    append(meshes.glove, ball, {0.041, 0.017, 0.05}, {});
    constexpr double relaxed = 0.35, bent = 1.9;
    constexpr struct {
        double place, length_m;
    } fingers[] = {{0.027, 0.068}, {0.009, 0.075}, {-0.009, 0.07}, {-0.026, 0.055}};
    for (int i = 0; i < 4; ++i) {
        const bool is_index = i == 0;
        const double angle = !points ? relaxed + 0.08 * i : is_index ? 0 : bent;
        append_finger(meshes.glove, {inwards * fingers[i].place, -0.002, -0.036},
                      points && !is_index ? 0.6 * fingers[i].length_m : fingers[i].length_m, angle,
                      0);
    }
    append_finger(meshes.glove, {inwards * 0.035, -0.006, -0.002}, 0.05, 0.3, inwards * 0.7);
    append(meshes.cuff, ball, {0.03, 0.024, 0.02}, {0, 0, 0.052});
    return meshes;
}

MeshData disc_mesh(double radius_m) {
    constexpr int corners = 48;
    MeshData mesh;
    mesh.vertices.push_back(vertex({}, {0, 0, -1}));
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double angle = 2 * pi * i / corners;
        mesh.vertices.push_back(
            vertex({radius_m * std::cos(angle), radius_m * -std::sin(angle), 0}, {0, 0, -1}));
        mesh.indices.insert(mesh.indices.end(), {0, 1 + i, 1 + (i + 1) % corners});
    }
    return mesh;
}

MeshData view_cone_mesh() {
    // Listed upwards, and then laid down: up becomes forward.
    constexpr Ring cone[] = {
        {-0.045, 0, 0}, {-0.045, 0.034, 0.034}, {0.055, 0.004, 0.004}, {0.057, 0, 0}};
    MeshData mesh;
    append_turned(mesh, loft(cone), {1, 1, 1}, {rotation_about({1, 0, 0}, -pi / 2), {}});
    return mesh;
}

}  // namespace theatron::room
