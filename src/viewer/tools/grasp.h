// SPDX-License-Identifier: Apache-2.0
// An object at the end of a ray: of the mouse, which leaves its direction as it was, or of a hand,
// with which it also turns.
//
// Uses no clock and no GL.
#pragma once

#include "geometry/vec.h"
#include "render/pick.h"

namespace theatron::viewer {

// The ray of the mouse, which does not turn, or a hand with its own rotation and a shorter reach.
struct Grip {
    render::PickRay ray;
    Quat rotation = {};
    double least_distance_m = 0.3, largest_distance_m = 20;
};
// The grip of a hand whose ray goes along -z of this pose.
Grip grip_of_hand(const Pose& room_from_aim);

class Grasp {
public:
    static constexpr double approach_per_click = 0.9;  // of the distance
    static constexpr double turn_per_click = 15;       // degrees about the vertical

    // Holds the object at `place` (room, metres), which is on the grip's ray.
    Grasp(const Pose& room_from_object, const Grip& grip, Vec3 place);

    // Moves with another ray or hand; nearer by positive clicks; farther by metres; turns to the
    // left about the place where it is held.
    void point(const Grip& grip) { grip_ = grip; }
    void approach(double clicks);
    void push(double metres);
    void turn(double degrees);

    Pose room_from_object() const;

private:
    Pose room_from_grip() const;
    void set_distance(double metres);

    Grip grip_;
    double distance_m_ = 0;
    Pose grip_from_object_;  // the grip's origin is where the object is held
};

}  // namespace theatron::viewer
