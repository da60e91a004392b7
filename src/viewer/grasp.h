// SPDX-License-Identifier: Apache-2.0
// An object that the mouse holds: it stays under the pointer, with its distance and orientation.
//
// Uses no clock and no GL.
#pragma once

#include "geometry/vec.h"
#include "render/pick.h"

namespace theatron::viewer {

class Grasp {
public:
    static constexpr double least_distance_m = 0.3, largest_distance_m = 20;
    static constexpr double approach_per_click = 0.9;  // of the distance
    static constexpr double turn_per_click = 15;       // degrees about the vertical

    // Holds the object at `place` (room, metres), which is on `ray`.
    Grasp(const Pose& room_from_object, const render::PickRay& ray, Vec3 place);

    // Moves to another ray; nearer by positive clicks; turns left by positive clicks.
    void point(const render::PickRay& ray) { ray_ = ray; }
    void approach(double clicks);
    void turn(double clicks);

    Pose room_from_object() const;

private:
    render::PickRay ray_;
    double distance_m_;
    Pose place_from_object_;  // origin where it is held, axes of the room
};

}  // namespace theatron::viewer
