// SPDX-License-Identifier: Apache-2.0
// An object that the mouse holds: it stays under the pointer, in its distance, as it is turned.
//
// Pure.
#pragma once

#include "geometry/vec.h"
#include "render/pick.h"

namespace theatron::viewer {

class Grasp {
public:
    static constexpr double least_distance_m = 0.3, largest_distance_m = 20;
    static constexpr double approach_per_click = 0.9;  // of the distance
    static constexpr double turn_per_click = 15;       // degrees about the vertical

    // Taken at `place`, which `ray` meets.
    Grasp(const Pose& room_from_object, const render::PickRay& ray, Vec3 place);

    // The pointer is on another ray; a positive click comes closer.
    void point(const render::PickRay& ray) { ray_ = ray; }
    void approach(double clicks);
    void turn(double clicks);

    Pose room_from_object() const;

private:
    render::PickRay ray_;
    double distance_m_;
    Pose place_from_object_;  // about the place where it is held, with the room's axes
};

}  // namespace theatron::viewer
