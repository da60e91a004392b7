// SPDX-License-Identifier: Apache-2.0
#include "viewer/worn_headsets.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

using namespace std::chrono_literals;
using wire::PersonPose;

constexpr ParticipantId ben{1};

PersonPose with(bool left, bool right, bool points) {
    PersonPose pose;
    pose.head.emplace();
    if (left)
        pose.left_hand.emplace();
    if (right)
        pose.right_hand.emplace();
    pose.points = points;
    return pose;
}

TEST(WornHeadsets, AMouseThatPointsIsNone) {
    WornHeadsets headsets;
    for (const PersonPose& pose : {with(false, false, false), with(false, true, true)}) {
        headsets.take({{ben, pose}}, from_us(0));
        EXPECT_FALSE(headsets.has(ben));
    }
}

TEST(WornHeadsets, HandsThatAreFollowedMakeOne) {
    for (const PersonPose& pose :
         {with(true, false, false), with(false, true, false), with(true, true, true)}) {
        WornHeadsets headsets;
        headsets.take({{ben, pose}}, from_us(0));
        EXPECT_TRUE(headsets.has(ben));
    }
}

TEST(WornHeadsets, HandsOutOfSightChangeNothingForAWhile) {
    WornHeadsets headsets;
    TimePoint now = from_us(0);
    headsets.take({{ben, with(true, true, false)}}, now);
    now += WornHeadsets::forgotten_after;
    headsets.take({{ben, with(false, true, true)}}, now);
    EXPECT_TRUE(headsets.has(ben));
    headsets.take({{ben, with(false, false, false)}}, now + 1s);
    EXPECT_FALSE(headsets.has(ben));
}

TEST(WornHeadsets, ThoseWhoLeaveAreForgotten) {
    WornHeadsets headsets;
    headsets.take({{ben, with(true, true, false)}}, from_us(0));
    headsets.take({}, from_us(1));
    EXPECT_FALSE(headsets.has(ben));
}

}  // namespace
}  // namespace theatron::viewer
