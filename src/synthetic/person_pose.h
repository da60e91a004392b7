// SPDX-License-Identifier: Apache-2.0
// Converts a person's action (positions of the hands, direction of the eyes) to bones.
#pragma once

#include <array>

#include "synthetic/person.h"

namespace theatron::synthetic {

// The point in a right hand's frame where thumb and index hold a thing.
inline constexpr F3 grip_point{0.040f, -0.056f, 0.116f};

struct HandPose {
    F3 grip;            // position of the grip point in the room
    float yaw = 0;      // of the fingers, about the person's vertical axis, to the left
    float pitch = 0;    // downwards
    float roll = 0;     // raises the thumb's side
    float bend = 0.5f;  // of the fingers, see Grip
};

struct PersonPose {
    Affine root;  // position and orientation on the floor
    float lean = 0, sway = 0, breath = 0;
    F3 look_at;
    std::array<HandPose, 2> hands;  // left, right
};

// The palm's frame for that position of the grip point; side: 1 left, -1 right.
Affine palm_frame(const Affine& root, const HandPose& hand, float side);

// Writes the person's bones. Hands out of the arms' reach are moved closer; `palms` receives
// the resulting frames.
void pose_person(const PersonPose& pose, Affine* bones, std::array<Affine, 2>& palms);

}  // namespace theatron::synthetic
