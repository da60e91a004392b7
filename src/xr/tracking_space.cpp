// SPDX-License-Identifier: Apache-2.0
#include "xr/tracking_space.h"

namespace theatron::xr {
namespace {

constexpr Vec3 upwards{0, 1, 0};
// The cosine of the largest slope between two floors that are taken as parallel: 5 degrees.
constexpr double parallel = 0.996;

// The tracking space that has this rotation and leaves `in_floor` at `in_room`.
Pose space_through(const Quat& rotation, Vec3 in_floor, Vec3 in_room) {
    return {rotation, in_room - rotate(rotation, in_floor)};
}

}  // namespace

double heading_of(const Pose& pose) {
    Vec3 ahead = rotate(pose.rotation, {0, 0, -1});
    if (std::hypot(ahead.x, ahead.z) < 0.05)
        ahead = rotate(pose.rotation, {0, ahead.y < 0 ? 1.0 : -1.0, 0});
    return std::atan2(-ahead.x, -ahead.z);
}

Pose standing_space(const Pose& floor_from_head, Vec3 place, double heading) {
    const Vec3 head = floor_from_head.translation;
    const Quat rotation = rotation_about(upwards, heading - heading_of(floor_from_head));
    return space_through(rotation, {head.x, 0, head.z}, place);
}

std::optional<Pose> moved_space(const Pose& room_from_floor, const Pose& before_from_now) {
    const Vec3 moved = before_from_now.translation;
    // Written so that a number that is not finite fails, too.
    if (!(rotate(before_from_now.rotation, upwards).y >= parallel) || !std::isfinite(moved.x) ||
        !std::isfinite(moved.z))
        return std::nullopt;
    const Pose level{rotation_about(upwards, heading_of(before_from_now)), {moved.x, 0, moved.z}};
    return Pose{normalized(room_from_floor.rotation * level.rotation),
                room_from_floor * level.translation};
}

Pose turned_space(const Pose& room_from_floor, const Pose& floor_from_head, double degrees) {
    const Vec3 head = floor_from_head.translation;
    return space_through(
        normalized(rotation_about(upwards, radians_of(degrees)) * room_from_floor.rotation), head,
        room_from_floor * head);
}

}  // namespace theatron::xr
