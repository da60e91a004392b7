// SPDX-License-Identifier: Apache-2.0
#include "render/cloud_cut.h"

namespace theatron::render {
namespace {

constexpr double neck_behind_eyes_m = 0.1, middle_below_eyes_m = 0.55;
// A head with its hair, from behind the ears to the front of a headset.
constexpr double other_head_radius_m = 0.125, other_head_behind_m = 0.085, headset_before_m = 0.06;
constexpr double head_radius_m = 0.2, free_before_eyes_m = 0.12;

}  // namespace

Vec3 body_middle(const Pose& room_from_head) {
    const Vec3 neck = room_from_head * Vec3{0, 0, -neck_behind_eyes_m};
    return {neck.x, neck.y - middle_below_eyes_m, neck.z};
}

CloudCut other_person(const Pose& room_from_head, double reach_m) {
    CloudCut cut;
    cut.keep = {body_middle(room_from_head), reach_m};
    return cut;
}

CloudCut::Capsule head_of(const Pose& room_from_head) {
    return {room_from_head * Vec3{0, 0, -other_head_behind_m},
            room_from_head * Vec3{0, 0, headset_before_m}, other_head_radius_m};
}

CloudCut oneself(const Pose& room_from_head, double reach_m) {
    CloudCut cut = other_person(room_from_head, reach_m);
    cut.remove = {room_from_head * Vec3{0, 0, -neck_behind_eyes_m},
                  room_from_head * Vec3{0, 0, free_before_eyes_m}, head_radius_m};
    return cut;
}

}  // namespace theatron::render
