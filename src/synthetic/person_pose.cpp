// SPDX-License-Identifier: Apache-2.0
#include "synthetic/person_pose.h"

namespace theatron::synthetic {
namespace {

// The rotation by the smallest angle that maps unit vector a to unit vector b.
Affine turn_between(F3 a, F3 b) {
    const F3 axis = cross(a, b);
    const float s = length(axis);
    if (s < 1e-5f)
        return {};
    return rotation(axis * (1 / s), std::atan2(s, dot(a, b)));
}

Affine about(F3 pivot, const Affine& turn) {
    return translation(pivot) * turn * translation(-pivot);
}

F3 mirrored(F3 left, float side) {
    return {left.x * side, left.y, left.z};
}

void pose_arm(const Affine& torso, float side, Affine& palm, Affine& upper, Affine& fore) {
    const F3 shoulder_rest = mirrored(rest::shoulder, side);
    const F3 rest_direction = rest::arm_direction(side);
    const F3 elbow_rest = shoulder_rest + rest_direction * rest::upper_arm;
    const F3 shoulder = torso * shoulder_rest;
    F3 to_wrist = palm.origin - shoulder;
    constexpr float longest = rest::upper_arm + rest::forearm - 0.004f;
    if (length(to_wrist) > longest) {
        to_wrist = normalized(to_wrist) * longest;
        palm.origin = shoulder + to_wrist;
    }
    // The elbow is on a circle around the line from shoulder to wrist; down and outwards is
    // the natural side.
    const float d = std::max(length(to_wrist), 0.12f);
    const F3 line = to_wrist * (1 / d);
    constexpr float a = rest::upper_arm, b = rest::forearm;
    const float along = std::clamp((a * a - b * b + d * d) / (2 * d), -a, a);
    const float off = std::sqrt(std::max(a * a - along * along, 0.0f));
    const F3 hint = torso.turn(normalized({0.62f * side, -0.72f, -0.3f}));
    const F3 outwards = normalized(hint - line * dot(hint, line));
    const F3 elbow = shoulder + line * along + outwards * off;

    Affine torso_turn = torso;
    torso_turn.origin = {};
    const F3 rest_room = torso_turn.turn(rest_direction);
    const auto bone = [&](F3 from, F3 to, F3 pivot_rest) {
        return translation(from) * turn_between(rest_room, normalized(to - from)) * torso_turn *
               translation(-pivot_rest);
    };
    upper = bone(shoulder, elbow, shoulder_rest);
    fore = bone(elbow, palm.origin, elbow_rest);
}

}  // namespace

Affine palm_frame(const Affine& root, const HandPose& hand, float side) {
    const F3 flat{std::sin(hand.yaw), 0, std::cos(hand.yaw)};
    const F3 forward = root.turn(flat * std::cos(hand.pitch) - F3{0, std::sin(hand.pitch), 0});
    Affine palm = facing({}, forward, {0, 1, 0});
    palm = palm * rotation({0, 0, 1}, side < 0 ? hand.roll : -hand.roll);
    palm.origin = hand.grip - palm.turn(mirrored(grip_point, -side));
    return palm;
}

void pose_person(const PersonPose& pose, Affine* bones, std::array<Affine, 2>& palms) {
    const Affine torso =
        pose.root *
        about(rest::waist, rotation({1, 0, 0}, pose.lean) * rotation({0, 0, 1}, pose.sway)) *
        translation({0, 0.002f * pose.breath, 0.0025f * pose.breath});
    bones[lower] = pose.root;
    bones[chest] = torso;
    const F3 neck = torso * rest::neck;
    // The head turns by most of the angle, the eyes by the rest.
    const F3 eyes = neck + F3{0, 0.11f, 0};
    const F3 ahead = normalized(torso.turn({0, -0.05f, 1}));
    const F3 wanted = normalized(pose.look_at - eyes);
    const F3 forward = normalized(ahead * 0.42f + wanted * 0.58f);
    bones[head] = facing(neck, forward, normalized(torso.turn({0, 1, 0}) + F3{0, 1, 0}));
    for (const float side : {1.0f, -1.0f}) {
        const F3 at = bones[head] * mirrored(rest::eye, side);
        const F3 gaze = normalized(normalized(pose.look_at - at) + forward * 0.45f);
        bones[side > 0 ? eye_left : eye_right] = facing(at, gaze, {0, 1, 0});
    }
    for (int i = 0; i < 2; ++i) {
        const float side = i == 0 ? 1.0f : -1.0f;
        const HandPose& hand = pose.hands[std::size_t(i)];
        Affine& palm = palms[std::size_t(i)];
        palm = palm_frame(pose.root, hand, side);
        pose_arm(torso, side, palm, bones[i == 0 ? upper_arm_left : upper_arm_right],
                 bones[i == 0 ? forearm_left : forearm_right]);
        const Affine& arm = bones[i == 0 ? forearm_left : forearm_right];
        bones[i == 0 ? cuff_left : cuff_right] =
            facing(palm.origin, arm.turn(rest::arm_direction(side)), palm.y);
        const float b = hand.bend;
        pose_hand(palm, side,
                  {{b * 0.95f, b, b * 1.02f, std::min(b * 1.3f, 0.95f), std::min(b * 1.45f, 1.0f)}},
                  bones + (i == 0 ? hand_left : hand_right));
    }
}

}  // namespace theatron::synthetic
