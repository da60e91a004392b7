// SPDX-License-Identifier: Apache-2.0
#include "viewer/tools/grasp.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

TEST(Grasp, KeepsAnObjectUnderThePointer) {
    const Pose object{rotation_about({0, 1, 0}, 0.5), {0.1, 1, -2}};
    const render::PickRay ray{{0, 1, 0}, {0, 0, -1}};
    Grasp grasp(object, {ray}, {0, 1, -1.9});
    EXPECT_LT(length(grasp.room_from_object().translation - object.translation), 1e-12);
    grasp.point({{{0, 1, 0}, {1, 0, 0}}});
    const Vec3 moved = grasp.room_from_object().translation;
    EXPECT_LT(length(moved - Vec3{1.9 + 0.1, 1, -0.1}), 1e-12);
    grasp.approach(3);
    EXPECT_LT(grasp.room_from_object().translation.x, moved.x);
    grasp.approach(1000);
    EXPECT_NEAR(grasp.room_from_object().translation.x, Grip{}.least_distance_m + 0.1, 1e-12);
}

TEST(Grasp, TurnsAnObjectAboutThePlaceWhereItIsHeld) {
    const Vec3 held{0, 1, -2};
    const Pose object{{}, {0.1, 1, -2}};
    Grasp grasp(object, {{{0, 1, 0}, {0, 0, -1}}}, held);
    grasp.turn(90);
    const Pose turned = grasp.room_from_object();
    EXPECT_LT(length(turned.translation - Vec3{0, 1, -2.1}), 1e-9);
    EXPECT_LT(length(rotate(turned.rotation, {1, 0, 0}) - Vec3{0, 0, -1}), 1e-9);
}

TEST(Grasp, AHandTurnsWhatItHoldsAboutTheUprightAsAMouseDoes) {
    const Pose aim{rotation_about({1, 0, 0}, 0.4), {0, 1, 0}};
    const Vec3 held = aim * Vec3{0, 0, -1};
    const Pose object{rotation_about({0, 1, 0}, 0.5), held + Vec3{0.1, 0, 0}};
    Grasp grasp(object, grip_of_hand(aim), held);
    EXPECT_LT(length(grasp.room_from_object().translation - object.translation), 1e-12);
    grasp.turn(90);
    const Pose turned = grasp.room_from_object();
    EXPECT_LT(length(turned.translation - (held + Vec3{0, 0, -0.1})), 1e-9);
    EXPECT_LT(length(rotate(turned.rotation, {0, 1, 0}) - Vec3{0, 1, 0}), 1e-9);
}

}  // namespace
}  // namespace theatron::viewer
