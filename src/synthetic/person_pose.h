// SPDX-License-Identifier: Apache-2.0
// From what a person does (where the hands are, where the eyes look) to bones.
#pragma once

#include <array>

#include "synthetic/person.h"

namespace theatron::synthetic {

// Where in a right hand's frame thumb and index meet around a held thing.
inline constexpr F3 grip_point{0.040f, -0.056f, 0.116f};

struct HandPose {
    F3 grip;            // where the grip point is, in the room
    float yaw = 0;      // of the fingers, about the person's up, to the left
    float pitch = 0;    // downwards
    float roll = 0;     // the thumb's side turned up
    float bend = 0.5f;  // of the fingers, see Grip
};

struct PersonPose {
    Affine root;  // where the person stands
    float lean = 0, sway = 0, breath = 0;
    F3 look_at;
    std::array<HandPose, 2> hands;  // left, right
};

// Frame of the palm that puts the grip point there; side: 1 left, -1 right.
Affine palm_frame(const Affine& root, const HandPose& hand, float side);

// Writes the person's bones. The hands are moved where the arms cannot reach, and
// `palms` tells where they are then.
void pose_person(const PersonPose& pose, Affine* bones, std::array<Affine, 2>& palms);

}  // namespace theatron::synthetic
