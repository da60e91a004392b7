// SPDX-License-Identifier: Apache-2.0
// How a person moves through the room: walls, floor and furniture that stop them, and the arc of a
// teleport.
//
// Pure functions, in metres of the room.
#pragma once

#include <optional>
#include <vector>

#include "base/ids.h"
#include "furniture/extent.h"
#include "furniture/model.h"

namespace theatron::room {

// Heights of a person's eyes above the floor.
inline constexpr double standing_eyes_m = 1.65, sitting_eyes_m = 1.2;

using RoomExtent = furniture::Extent;

// The room without what stands in it.
struct FreeSpace {
    RoomExtent extent;
    std::vector<furniture::Box> obstacles;
};

// The place nearest to `eye` that is inside of the walls, above the floor and outside of the
// obstacles. An eye may be above or below an obstacle. Between two obstacles that leave no space
// the last one counts.
Vec3 kept_inside(const FreeSpace& space, Vec3 eye);

// Where a person begins in a meeting without cameras: the pose of an eye (z forward, y down) that
// stands on a circle around the room's origin and looks at its middle. People with numbers near to
// each other stand apart.
Pose meeting_place(ParticipantId person);

struct TeleportArc {
    std::vector<Vec3> points;  // from the hand to where the arc ends
    // The place on the floor; none if the arc ends at a wall or an obstacle, or too close to one.
    std::optional<Vec3> landing;
};

// The path of something that is thrown from `from` in direction `ahead` (of any length).
// Obstacles that stand in the way do not stop it: one can aim over a table.
TeleportArc teleport_arc(const FreeSpace& space, Vec3 from, Vec3 ahead);

// The pose of an eye (z forward, y down) that stands at `landing` and looks horizontally where
// `room_from_eye` looks.
Pose standing_at(Vec3 landing, const Pose& room_from_eye, double eyes_m);

}  // namespace theatron::room
