// SPDX-License-Identifier: Apache-2.0
#include "render/cloud_cut.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace theatron::render {
namespace {

TEST(CloudCut, TheBodyHangsBelowTheHeadWhereverItLooks) {
    const Pose ahead = look_at({1, 1.7, 2}, {1, 1.7, 5}, {0, 1, 0});
    const Pose down = look_at({1, 1.7, 2}, {1, 0.7, 2.5}, {0, 1, 0});
    for (const Pose& head : {ahead, down}) {
        const Vec3 middle = body_middle(head);
        EXPECT_NEAR(middle.x, 1, 0.12);
        EXPECT_NEAR(middle.y, 1.2, 0.12);
        EXPECT_NEAR(middle.z, 2, 0.12);
    }
}

TEST(CloudCut, OnesOwnHandsStayAndTheHeadsetGoes) {
    const Pose head = look_at({0, 1.7, 0}, {0, 1.7, 1}, {0, 1, 0});
    const CloudCut cut = oneself(head);
    const Vec3 headset{0, 1.72, 0.08}, hand{0.15, 1.3, 0.45};
    EXPECT_LT(length(headset - cut.remove->to), cut.remove->radius_m);
    EXPECT_GT(length(hand - cut.remove->to), cut.remove->radius_m + cut.border_m);
    EXPECT_LT(length(hand - cut.keep->middle), cut.keep->radius_m - cut.border_m);
}

TEST(CloudCut, AHeadGoesWithItsHeadsetAndLeavesTheNeck) {
    const CloudCut::Capsule head = head_of(look_at({0, 1.7, 0}, {0, 1.7, 1}, {0, 1, 0}));
    const auto is_gone = [&](Vec3 place) {
        const Vec3 axis = head.to - head.from;
        const double along = std::clamp(dot(place - head.from, axis) / dot(axis, axis), 0.0, 1.0);
        return length(place - head.from - along * axis) < head.radius_m;
    };
    EXPECT_TRUE(is_gone({0, 1.7, 0.15}));      // the headset's front
    EXPECT_TRUE(is_gone({0.08, 1.68, -0.1}));  // an ear
    EXPECT_TRUE(is_gone({0, 1.6, 0}));         // the mouth
    EXPECT_FALSE(is_gone({0, 1.54, -0.05}));   // the neck
    EXPECT_FALSE(is_gone({0.2, 1.5, 0}));      // a shoulder
}

}  // namespace
}  // namespace theatron::render
