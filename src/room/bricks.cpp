// SPDX-License-Identifier: Apache-2.0
#include "room/bricks.h"

#include <algorithm>
#include <cmath>

#include "room/mesh_parts.h"

namespace theatron::room {
namespace {

constexpr double snap_distance_m = 0.025;
const double snap_cosine = std::cos(radians_of(20) / 2);
constexpr double stud_radius_m = 0.012, stud_height_m = 0.009;
// A gap between neighbouring bricks, so that their border is visible.
constexpr double gap_m = 0.0004;

Vec3 half_size(const Brick& brick) {
    return {0.5 * brick.studs_x * stud_pitch_m, brick_height_m, 0.5 * brick.studs_z * stud_pitch_m};
}

// The multiple of the pitch that puts studs of one side over those of the other: whole where both
// have an even or both an odd number, else half.
double on_grid(double offset, int studs, int other_studs) {
    const double shift = (studs + other_studs) % 2 == 0 ? 0 : 0.5 * stud_pitch_m;
    return std::round((offset - shift) / stud_pitch_m) * stud_pitch_m + shift;
}

// The largest distance of a bottom corner between two poses.
double corner_distance(const Brick& brick, const Pose& a, const Pose& b) {
    const Vec3 half = half_size(brick);
    double most = 0;
    for (const double x : {-half.x, half.x})
        for (const double z : {-half.z, half.z})
            most = std::max(most, length(a * Vec3{x, 0, z} - b * Vec3{x, 0, z}));
    return most;
}

render::MeshData stud_mesh();

}  // namespace

Bytes encode_brick(const Brick& brick) {
    return {std::byte(brick.studs_x), std::byte(brick.studs_z), std::byte(brick.color)};
}

std::optional<Brick> decode_brick(ByteView properties) {
    if (properties.size() != 3)
        return std::nullopt;
    const Brick brick{std::to_integer<int>(properties[0]), std::to_integer<int>(properties[1]),
                      std::to_integer<std::uint8_t>(properties[2])};
    const auto is_side = [](int studs) { return studs >= 1 && studs <= most_studs; };
    if (!is_side(brick.studs_x) || !is_side(brick.studs_z))
        return std::nullopt;
    return brick;
}

Pose snapped(const Brick& brick, const Pose& released, const std::vector<PlacedBrick>& others) {
    Pose best = released;
    double nearest = snap_distance_m;
    for (const PlacedBrick& other : others) {
        const Pose other_from_brick = inverse(other.room_from_brick) * released;
        for (int quarter = 0; quarter < 4; ++quarter) {
            const Quat turned = rotation_about({0, 1, 0}, radians_of(90) * quarter);
            const Quat& q = other_from_brick.rotation;
            const double cosine =
                std::abs(q.w * turned.w + q.x * turned.x + q.y * turned.y + q.z * turned.z);
            if (cosine < snap_cosine)
                continue;
            const bool crosswise = quarter % 2 == 1;
            const int along_x = crosswise ? brick.studs_z : brick.studs_x;
            const int along_z = crosswise ? brick.studs_x : brick.studs_z;
            const Vec3 p = other_from_brick.translation;
            const double x = on_grid(p.x, along_x, other.brick.studs_x);
            const double z = on_grid(p.z, along_z, other.brick.studs_z);
            // At least one stud is shared.
            if (std::abs(x) >= 0.5 * stud_pitch_m * (along_x + other.brick.studs_x) ||
                std::abs(z) >= 0.5 * stud_pitch_m * (along_z + other.brick.studs_z))
                continue;
            for (const double y : {brick_height_m, -brick_height_m}) {
                const Pose candidate = other.room_from_brick * Pose{turned, {x, y, z}};
                const double distance = corner_distance(brick, released, candidate);
                if (distance < nearest) {
                    nearest = distance;
                    best = candidate;
                }
            }
        }
    }
    return best;
}

render::MeshData make_brick_mesh(const Brick& brick) {
    const Vec3 half = half_size(brick);
    render::MeshData mesh = render::make_box_mesh({-half.x + gap_m, 0, -half.z + gap_m},
                                                  {half.x - gap_m, half.y, half.z - gap_m});
    const render::MeshData stud = stud_mesh();
    for (int i = 0; i < brick.studs_x; ++i)
        for (int k = 0; k < brick.studs_z; ++k)
            append(mesh, stud, {1, 1, 1},
                   {(i + 0.5) * stud_pitch_m - half.x, half.y, (k + 0.5) * stud_pitch_m - half.z});
    return mesh;
}

namespace {

// A cylinder without a bottom.
render::MeshData stud_mesh() {
    constexpr int sides = 16;
    render::MeshData mesh;
    const auto add = [&](Vec3 p, Vec3 n) {
        mesh.vertices.push_back(
            {float(p.x), float(p.y), float(p.z), float(n.x), float(n.y), float(n.z)});
        return std::uint32_t(mesh.vertices.size() - 1);
    };
    const auto around = [](int side) {
        const double angle = 2 * std::numbers::pi * side / sides;
        return Vec3{std::cos(angle), 0, -std::sin(angle)};
    };
    const Vec3 up{0, stud_height_m, 0};
    const std::uint32_t middle = add(up, {0, 1, 0});
    for (int side = 0; side < sides; ++side) {
        const Vec3 a = around(side), b = around(side + 1);
        const std::uint32_t top_a = add(stud_radius_m * a + up, {0, 1, 0});
        const std::uint32_t top_b = add(stud_radius_m * b + up, {0, 1, 0});
        mesh.indices.insert(mesh.indices.end(), {middle, top_a, top_b});
        const std::uint32_t low_a = add(stud_radius_m * a, a), low_b = add(stud_radius_m * b, b);
        const std::uint32_t high_a = add(stud_radius_m * a + up, a);
        const std::uint32_t high_b = add(stud_radius_m * b + up, b);
        mesh.indices.insert(mesh.indices.end(), {low_a, low_b, high_b, low_a, high_b, high_a});
    }
    return mesh;
}

}  // namespace

}  // namespace theatron::room
