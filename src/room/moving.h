// SPDX-License-Identifier: Apache-2.0
// How a person moves through the room: walls and floor that stop them, and the arc of a teleport.
//
// Pure functions, in metres of the room.
#pragma once

#include <optional>
#include <vector>

#include "base/ids.h"
#include "room/virtual_room.h"

namespace theatron::room {

// Heights of a person's eyes above the floor.
inline constexpr double standing_eyes_m = 1.65, sitting_eyes_m = 1.2;

// The place nearest to `eye` that is inside of the walls and above the floor.
Vec3 kept_inside(const RoomExtent& extent, Vec3 eye);

// Where a person begins in a meeting without cameras: the pose of an eye (z forward, y down) that
// stands on a circle around the room's origin and looks at its middle. People with numbers near to
// each other stand apart.
Pose meeting_place(ParticipantId person);

struct TeleportArc {
    std::vector<Vec3> points;  // from the hand to where the arc ends
    // The place on the floor; none if the arc ends at a wall or too close to one.
    std::optional<Vec3> landing;
};

// The path of something that is thrown from `from` in direction `ahead` (of any length).
TeleportArc teleport_arc(const RoomExtent& extent, Vec3 from, Vec3 ahead);

// The pose of an eye (z forward, y down) that stands at `landing` and looks horizontally where
// `room_from_eye` looks.
Pose standing_at(Vec3 landing, const Pose& room_from_eye, double eyes_m);

}  // namespace theatron::room
