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

bool is_inside(const RoomExtent& extent, Vec3 place, double margin) {
    return place.x >= extent.left + margin && place.x <= extent.right - margin &&
           place.z >= extent.back + margin && place.z <= extent.front - margin;
}

}  // namespace

Vec3 kept_inside(const RoomExtent& extent, Vec3 eye) {
    return {std::clamp(eye.x, extent.left + wall_margin_m, extent.right - wall_margin_m),
            std::max(eye.y, least_eyes_m),
            std::clamp(eye.z, extent.back + wall_margin_m, extent.front - wall_margin_m)};
}

TeleportArc teleport_arc(const RoomExtent& extent, Vec3 from, Vec3 ahead) {
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
            if (is_inside(extent, floor, landing_margin_m))
                arc.landing = Vec3{floor.x, 0, floor.z};
            break;
        }
        if (!is_inside(extent, next, 0))
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
