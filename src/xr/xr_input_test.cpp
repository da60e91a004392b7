// SPDX-License-Identifier: Apache-2.0
#include "xr/xr_input.h"

#include <gtest/gtest.h>

namespace theatron::xr {
namespace {

constexpr std::array<bool, 2> holds_nothing{};

HeadsetFrame with_controllers() {
    HeadsetFrame frame;
    frame.hands[left_side].emplace();
    frame.hands[right_side].emplace();
    return frame;
}

// A bare hand with this gap between thumb and index finger; `curled` are the other fingers.
HandState bare_hand(double gap_m, bool curled = false) {
    HandState hand;
    HandJoints joints;
    joints.index_tip = {0, 0, -0.17};
    joints.thumb_tip = {gap_m, 0, -0.17};
    joints.middle_tip = joints.ring_tip = {0, 0, curled ? -0.08 : -0.18};
    hand.joints = joints;
    return hand;
}

TEST(XrInput, ATriggerTakesOnceHoldsAndLetsGo) {
    XrInput input;
    HeadsetFrame frame = with_controllers();
    frame.hands[right_side]->trigger = 1;
    const HandIntents taken = input.update(frame, holds_nothing).hands[right_side];
    EXPECT_TRUE(taken.takes && taken.holds && !taken.is_bare);
    const Intents later = input.update(frame, holds_nothing);
    EXPECT_TRUE(!later.hands[right_side].takes && later.hands[right_side].holds);
    EXPECT_FALSE(later.hands[left_side].holds);
    frame.hands[right_side]->trigger = 0;
    EXPECT_TRUE(input.update(frame, holds_nothing).hands[right_side].lets_go);
    EXPECT_FALSE(input.update(frame, holds_nothing).hands[right_side].lets_go);
}

TEST(XrInput, ATriggerThatTremblesHalfwayChangesNothing) {
    XrInput input;
    HeadsetFrame frame = with_controllers();
    int takes = 0;
    for (const double value : {0.3, 0.7, 0.5, 0.65, 0.45, 0.7, 0.5}) {
        frame.hands[right_side]->trigger = value;
        takes += input.update(frame, holds_nothing).hands[right_side].takes;
    }
    EXPECT_EQ(takes, 1);
}

TEST(XrInput, APinchTakesAndAnOpenHandLetsGo) {
    XrInput input;
    HeadsetFrame frame;
    frame.hands[left_side] = bare_hand(0.06);
    EXPECT_FALSE(input.update(frame, holds_nothing).hands[left_side].holds);
    frame.hands[left_side] = bare_hand(0.01);
    const HandIntents pinched = input.update(frame, holds_nothing).hands[left_side];
    EXPECT_TRUE(pinched.takes && pinched.is_bare);
    frame.hands[left_side] = bare_hand(0.025);
    EXPECT_TRUE(input.update(frame, holds_nothing).hands[left_side].holds);
    frame.hands[left_side] = bare_hand(0.05);
    EXPECT_TRUE(input.update(frame, holds_nothing).hands[left_side].lets_go);
}

TEST(XrInput, ALostHandLetsGo) {
    XrInput input;
    HeadsetFrame frame;
    frame.hands[right_side] = bare_hand(0.01);
    (void)input.update(frame, holds_nothing);
    frame.hands[right_side].reset();
    const HandIntents lost = input.update(frame, holds_nothing).hands[right_side];
    EXPECT_TRUE(lost.lets_go && !lost.is_present);
}

TEST(XrInput, OneFingerPointsAndAnOpenHandDoesNot) {
    XrInput input;
    HeadsetFrame frame;
    frame.hands[right_side] = bare_hand(0.06);
    EXPECT_FALSE(input.update(frame, holds_nothing).hands[right_side].points);
    frame.hands[right_side] = bare_hand(0.06, true);
    EXPECT_TRUE(input.update(frame, holds_nothing).hands[right_side].points);
    frame = with_controllers();
    frame.hands[left_side]->squeeze = 1;
    EXPECT_TRUE(input.update(frame, holds_nothing).hands[left_side].points);
}

TEST(XrInput, TheRightStickTurnsInStepsThatNeedRestBetweenThem) {
    XrInput input;
    HeadsetFrame frame = with_controllers();
    double turned = 0;
    for (const double x : {0.9, 1.0, 0.6, 0.9, 0.1, 0.9}) {
        frame.hands[right_side]->stick = {x, 0};
        turned += input.update(frame, holds_nothing).turn_degrees;
    }
    EXPECT_EQ(turned, -2 * XrInput::snap_degrees);
    frame.hands[right_side]->stick = {-0.1, 0};
    (void)input.update(frame, holds_nothing);
    frame.hands[right_side]->stick = {-0.9, 0};
    EXPECT_EQ(input.update(frame, holds_nothing).turn_degrees, XrInput::snap_degrees);
}

TEST(XrInput, TheRightStickForwardAimsATeleportThatHappensWhenItIsLetGo) {
    XrInput input;
    HeadsetFrame frame = with_controllers();
    frame.hands[right_side]->stick = {0.2, 0.9};
    EXPECT_TRUE(input.update(frame, holds_nothing).hands[right_side].aims_teleport);
    frame.hands[right_side]->stick = {0.9, 0.5};
    const Intents aimed = input.update(frame, holds_nothing);
    EXPECT_TRUE(aimed.hands[right_side].aims_teleport);
    EXPECT_EQ(aimed.turn_degrees, 0);
    frame.hands[right_side]->stick = {};
    EXPECT_TRUE(input.update(frame, holds_nothing).hands[right_side].teleports);
    EXPECT_FALSE(input.update(frame, holds_nothing).hands[right_side].teleports);
}

TEST(XrInput, TheLeftStickWalksUnlessItIsTheOnlyOne) {
    XrInput input;
    HeadsetFrame frame = with_controllers();
    frame.hands[left_side]->stick = {0.1, 0.8};
    const Intents walking = input.update(frame, holds_nothing);
    EXPECT_EQ(walking.walk, (Vec2{0, 0.8}));
    EXPECT_FALSE(walking.hands[left_side].aims_teleport);
    frame.hands[right_side].reset();
    const Intents alone = input.update(frame, holds_nothing);
    EXPECT_EQ(alone.walk, Vec2{});
    EXPECT_TRUE(alone.hands[left_side].aims_teleport);
}

TEST(XrInput, TheStickOfAHandThatHoldsMovesTheObject) {
    XrInput input;
    HeadsetFrame frame = with_controllers();
    frame.hands[right_side]->stick = {0.9, -0.9};
    const Intents intents = input.update(frame, {false, true});
    EXPECT_EQ(intents.turn_degrees, 0);
    EXPECT_EQ(intents.hands[right_side].pushes_away, -0.9);
    EXPECT_EQ(intents.hands[right_side].turns_held, -0.9);
}

TEST(XrInput, ButtonsActOnceWhenTheyArePressed) {
    XrInput input;
    HeadsetFrame frame = with_controllers();
    int menus = 0, gives = 0;
    for (const bool down : {true, true, false, true}) {
        frame.hands[left_side]->upper_button = down;
        frame.hands[right_side]->lower_button = down;
        const Intents intents = input.update(frame, holds_nothing);
        menus += intents.menu;
        gives += intents.hands[right_side].gives;
    }
    EXPECT_EQ(menus, 2);
    EXPECT_EQ(gives, 2);
}

}  // namespace
}  // namespace theatron::xr
