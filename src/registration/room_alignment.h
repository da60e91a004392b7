// SPDX-License-Identifier: Apache-2.0
// Where the room is: its floor, found in the depth images of a rig whose cameras are registered to
// each other.
#pragma once

#include <optional>
#include <vector>

#include "geometry/ray_table.h"
#include "registration/rig_solver.h"

namespace theatron::registration {

// The lowest large level surface in a depth image: half a metre or more below the camera, and at
// least 0.3 square metres of it seen. The camera may look up or down by up to 60 degrees and roll
// by as much. Camera frame. Nothing where no such surface is seen.
std::optional<FoundPlane> find_floor(DepthView depth, double depth_unit_mm, const Image<Ray>& rays);

// The largest surface that is parallel to the floor and 0.55 to 1.25 m above it, with at least 0.3
// square metres of it seen; all in the camera's frame. Nothing where there is none.
std::optional<FoundPlane> find_table(DepthView depth, double depth_unit_mm, const Image<Ray>& rays,
                                     const Plane& floor);

// The room's frame: y up from the floor; its origin lies below `middle`, and -z is where the
// reference camera looks. `floor` and `middle` are in the reference's frame. Without a floor the
// reference camera is taken to be level, 1.5 m up.
Pose room_from_reference(const std::optional<Plane>& floor, Vec3 middle);

}  // namespace theatron::registration
