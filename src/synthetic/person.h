// SPDX-License-Identifier: Apache-2.0
// A person at work: a skeleton, and skinned meshes that follow it.
//
// In the rest pose the body stands on the floor at the origin, facing +z; its left is +x.
// Heads and hands have rest poses in their own frames: the head around the top of its neck;
// the hand with the wrist at the origin, fingers along +z, the back of the hand up (+y) and,
// for the right hand, the thumb at +x.
#pragma once

#include "synthetic/scene.h"

namespace theatron::synthetic {

enum PersonBone : std::uint16_t {
    lower,  // hips, skirt, legs
    chest,
    head,
    upper_arm_left,
    forearm_left,
    upper_arm_right,
    forearm_right,
    hand_left,  // the palm, then five fingers of three joints
    hand_right = hand_left + 16,
    eye_left = hand_right + 16,
    eye_right,
    cuff_left,  // the end of the glove over the sleeve
    cuff_right,
    person_bones_used
};
static_assert(person_bones_used <= person_bone_count);

// Lengths and joints of the rest pose (metres).
namespace rest {
inline constexpr F3 waist{0, 1.05f, 0};
inline constexpr F3 neck{0, 1.485f, 0.0f};
inline constexpr F3 shoulder{0.178f, 1.415f, -0.012f};  // the left one
inline constexpr float upper_arm = 0.285f, forearm = 0.255f;
F3 arm_direction(float side);  // along the straight arm; side: 1 left, -1 right
inline constexpr F3 eye{0.0315f, 0.1125f, 0.0795f};  // in the head's frame
}  // namespace rest

struct PersonLooks {
    Look gown, cap, face, glove;
    bool loupes = false;
    std::uint32_t seed = 0;
};

void add_body(MovingMesh& out, std::uint16_t first_bone, const PersonLooks& looks, double detail);
void add_head(MovingMesh& out, std::uint16_t first_bone, const PersonLooks& looks, double detail);
void add_hands(MovingMesh& out, std::uint16_t first_bone, const PersonLooks& looks, double detail);

// One finger's joints in the right hand's frame: base, two knuckles, tip.
struct Finger {
    F3 joint[4];
    float radius[4];
    F3 bend_axis;
};
const Finger& finger(int number);  // 0: thumb … 4: little finger

// Flexion of each finger, 0 straight to 1 fist.
struct Grip {
    float bend[5];
};
// The sixteen bones of a hand whose palm is at `palm`; `side` 1 for the left.
void pose_hand(const Affine& palm, float side, const Grip& grip, Affine* bones);

}  // namespace theatron::synthetic
