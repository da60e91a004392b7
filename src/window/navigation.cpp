// SPDX-License-Identifier: Apache-2.0
#include "window/navigation.h"

#include <algorithm>
#include <cmath>

#include "render/camera_view.h"

namespace theatron::window {
namespace {

constexpr double degrees_per_height = 180;
constexpr double closer_per_click = 0.88;
constexpr double closest_m = 0.15;
constexpr double speed_m_per_s = 1.0, fast_m_per_s = 3.0;
// A picture that took longer must not throw the eye through the wall.
constexpr Duration longest_step = 250ms;
// How far the eye's upward direction must still point up: some degrees before looking
// straight down, where left and right would change places.
constexpr double least_up = 0.05;

constexpr Vec3 right{1, 0, 0}, down{0, 1, 0}, forward{0, 0, 1};

double uprightness(const Pose& room_from_eye) {
    return -rotate(room_from_eye.rotation, down).y;
}

Viewpoint turned(const Viewpoint& from, Vec2 drag) {
    const double yaw = -drag.x * degrees_per_height, pitch = drag.y * degrees_per_height;
    render::CameraView view;
    view.room_from_eye = from.room_from_eye;
    const auto carried = [&](double by_pitch) {
        return render::orbited(view, from.pivot, yaw, by_pitch).room_from_eye;
    };
    const Pose wanted = carried(pitch);
    // A camera may itself be upside down: then only turns that tilt the view further are refused.
    const double before = uprightness(from.room_from_eye), after = uprightness(wanted);
    const bool too_far = after < least_up && after < before;
    return {too_far ? carried(0) : wanted, from.pivot};
}

Viewpoint moved(const Viewpoint& from, Vec3 way) {
    Viewpoint to = from;
    to.room_from_eye.translation = from.room_from_eye.translation + way;
    to.pivot = from.pivot + way;
    return to;
}

Viewpoint slid(const Viewpoint& from, Vec2 drag, double view_height) {
    const Vec3 pivot_from_eye = inverse(from.room_from_eye) * from.pivot;
    const double metres = view_height * std::max(pivot_from_eye.z, closest_m);
    const Vec3 way = (right * -drag.x + down * -drag.y) * metres;
    return moved(from, rotate(from.room_from_eye.rotation, way));
}

Viewpoint approached(const Viewpoint& from, double clicks) {
    const Vec3 way = from.room_from_eye.translation - from.pivot;
    const double distance = length(way);
    if (distance < 1e-6)
        return from;
    // An eye that is already closer than closest_m, because it flew there, stays.
    const double least = std::min(closest_m, distance);
    const double wanted = std::max(distance * std::pow(closer_per_click, clicks), least);
    Viewpoint to = from;
    to.room_from_eye.translation = from.pivot + way * (wanted / distance);
    return to;
}

Viewpoint flown(const Viewpoint& from, Vec3 keys, bool fast, Duration elapsed) {
    const double step =
        (fast ? fast_m_per_s : speed_m_per_s) * to_seconds(std::min(elapsed, longest_step));
    const Vec3 in_eye = right * keys.x + forward * keys.z;
    const Vec3 way = rotate(from.room_from_eye.rotation, in_eye) + Vec3{0, keys.y, 0};
    return moved(from, way * step);
}

}  // namespace

Viewpoint around(const Viewpoint& from, Vec2 place, double along_m) {
    return {from.room_from_eye, from.room_from_eye * (Vec3{place.x, place.y, 1} * along_m)};
}

bool Steering::moves() const {
    return turn != Vec2{} || slide != Vec2{} || approach != 0 || fly != Vec3{};
}

Viewpoint steered(const Viewpoint& from, const Steering& steering, double view_height,
                  Duration elapsed) {
    Viewpoint to = from;
    if (steering.turn != Vec2{})
        to = turned(to, steering.turn);
    if (steering.slide != Vec2{})
        to = slid(to, steering.slide, view_height);
    if (steering.approach != 0)
        to = approached(to, steering.approach);
    if (steering.fly != Vec3{})
        to = flown(to, steering.fly, steering.fast, elapsed);
    return to;
}

}  // namespace theatron::window
