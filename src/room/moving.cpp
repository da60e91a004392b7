// SPDX-License-Identifier: Apache-2.0
#include "room/moving.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace theatron::room {
namespace {

// An eye this near to a wall would see behind it.
constexpr double wall_margin_m = 0.15, least_eyes_m = 0.1;
// A person who lands this near to a wall would stand in it.
constexpr double landing_margin_m = 0.35;
constexpr double throw_m_per_s = 6.5, gravity_m_per_s2 = 9.81, step_s = 0.02;
constexpr int most_steps = 200;

// An eye this near to furniture would see into it.
constexpr double obstacle_margin_m = 0.12;
// A person who stands this near would stand in it.
constexpr double beside_obstacle_m = 0.2;

bool is_inside(const RoomExtent& extent, Vec3 place, double margin) {
    return place.x >= extent.left + margin && place.x <= extent.right - margin &&
           place.z >= extent.back + margin && place.z <= extent.front - margin;
}

// Moves the eye to the nearest side of the box, if it is in it.
Vec3 pushed_out(const furniture::Box& box, Vec3 eye) {
    const Vec3 margin{obstacle_margin_m, obstacle_margin_m, obstacle_margin_m};
    const Vec3 low = box.low - margin, high = box.high + margin;
    const struct {
        double depth;
        Vec3 out;
    } sides[] = {{eye.x - low.x, {-1, 0, 0}}, {high.x - eye.x, {1, 0, 0}},
                 {eye.z - low.z, {0, 0, -1}}, {high.z - eye.z, {0, 0, 1}},
                 {high.y - eye.y, {0, 1, 0}}, {eye.y - low.y, {0, -1, 0}}};
    const auto nearest =
        std::min_element(std::begin(sides), std::end(sides),
                         [](const auto& a, const auto& b) { return a.depth < b.depth; });
    return nearest->depth > 0 ? eye + nearest->out * nearest->depth : eye;
}

bool is_free_floor(const FreeSpace& space, Vec3 place) {
    return is_inside(space.extent, place, landing_margin_m) &&
           std::none_of(space.obstacles.begin(), space.obstacles.end(), [&](const auto& box) {
               return place.x > box.low.x - beside_obstacle_m &&
                      place.x < box.high.x + beside_obstacle_m &&
                      place.z > box.low.z - beside_obstacle_m &&
                      place.z < box.high.z + beside_obstacle_m;
           });
}

}  // namespace

Vec3 kept_inside(const FreeSpace& space, Vec3 eye) {
    for (const furniture::Box& box : space.obstacles)
        eye = pushed_out(box, eye);
    const RoomExtent& extent = space.extent;
    return {std::clamp(eye.x, extent.left + wall_margin_m, extent.right - wall_margin_m),
            std::max(eye.y, least_eyes_m),
            std::clamp(eye.z, extent.back + wall_margin_m, extent.front - wall_margin_m)};
}

TeleportArc teleport_arc(const FreeSpace& space, Vec3 from, Vec3 ahead) {
    TeleportArc arc;
    if (length(ahead) < 1e-9)
        return arc;
    Vec3 speed = normalized(ahead) * throw_m_per_s;
    Vec3 place = from;
    for (int step = 0; step < most_steps; ++step) {
        arc.points.push_back(place);
        const Vec3 next = place + speed * step_s;
        if (next.y <= 0) {
            const double share = place.y > 0 ? place.y / (place.y - next.y) : 0;
            const Vec3 floor = place + (next - place) * share;
            arc.points.push_back({floor.x, 0, floor.z});
            if (is_free_floor(space, floor))
                arc.landing = Vec3{floor.x, 0, floor.z};
            break;
        }
        if (!is_inside(space.extent, next, 0))
            break;
        place = next;
        speed.y -= gravity_m_per_s2 * step_s;
    }
    return arc;
}

Pose meeting_place(ParticipantId person) {
    constexpr double radius_m = 1.5, looks_at_m = 1.35;
    // Multiples of the golden angle never come near to each other early.
    const double angle = std::numbers::pi * (3 - std::sqrt(5.0)) * double(std::uint32_t(person));
    const Vec3 eye{radius_m * std::sin(angle), standing_eyes_m, radius_m * std::cos(angle)};
    return look_at(eye, {0, looks_at_m, 0}, {0, 1, 0});
}

Pose standing_at(Vec3 landing, const Pose& room_from_eye, double eyes_m) {
    Vec3 ahead = rotate(room_from_eye.rotation, {0, 0, 1});
    // A person who looks straight down looks on in the direction of the picture's upper border.
    if (std::hypot(ahead.x, ahead.z) < 0.05)
        ahead = rotate(room_from_eye.rotation, {0, -1, 0});
    const Vec3 eye{landing.x, landing.y + eyes_m, landing.z};
    return look_at(eye, eye + Vec3{ahead.x, 0, ahead.z}, {0, 1, 0});
}

}  // namespace theatron::room
