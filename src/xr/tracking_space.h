// SPDX-License-Identifier: Apache-2.0
// Where a headset's tracking space lies in the room: `room_from_floor` turns about the vertical and
// moves, so that the real floor stays level.
//
// Pure functions. Heads have y up and look along -z.
#pragma once

#include <optional>

#include "geometry/vec.h"

namespace theatron::xr {

// The angle about the vertical, in radians, of the direction in which a part looks; 0 along -z,
// positive to the left. A part that looks straight down has that of its upper side.
double heading_of(const Pose& pose);

// The tracking space in which the head is above or below `place` (at `place.y` plus its own height
// over the floor) and looks into the direction `heading`.
Pose standing_space(const Pose& floor_from_head, Vec3 place, double heading);

// The tracking space after its runtime has moved it: `before_from_now` has the new origin as it was
// seen from the old one. All in the room keeps its real place over the floor; the floor itself is
// where the runtime sees it now. Nothing if the two floors are not parallel, or a number is not
// finite: then nobody knows where the space is.
std::optional<Pose> moved_space(const Pose& room_from_floor, const Pose& before_from_now);

// The tracking space after a turn of the person about the head, positive to the left.
Pose turned_space(const Pose& room_from_floor, const Pose& floor_from_head, double degrees);

}  // namespace theatron::xr
