// SPDX-License-Identifier: Apache-2.0
#include "xr/tracking_space.h"

#include <gtest/gtest.h>

namespace theatron::xr {
namespace {

constexpr double exactly = 1e-9;
constexpr Vec3 upwards{0, 1, 0};

void expect_place(Vec3 a, Vec3 b) {
    EXPECT_NEAR(length(a - b), 0, exactly) << a.x << " " << a.y << " " << a.z;
}

// A head that looks to the left and down, beside the middle of the tracking space.
Pose some_head() {
    return {rotation_about(upwards, 0.7) * rotation_about({1, 0, 0}, -0.4), {0.5, 1.6, -0.2}};
}

TEST(TrackingSpace, HeadingIsTheAngleToTheLeft) {
    EXPECT_NEAR(heading_of({}), 0, exactly);
    EXPECT_NEAR(heading_of(some_head()), 0.7, exactly);
    // Straight down: the upper side of the picture.
    EXPECT_NEAR(
        heading_of({rotation_about(upwards, 0.3) * rotation_about({1, 0, 0}, -radians_of(90)), {}}),
        0.3, exactly);
}

TEST(TrackingSpace, TheHeadStandsOverThePlaceAndLooksAhead) {
    const Pose head = standing_space(some_head(), {2, 0, 3}, 1.1) * some_head();
    expect_place(head.translation, {2, 1.6, 3});
    EXPECT_NEAR(heading_of(head), 1.1, exactly);
}

TEST(TrackingSpace, ATurnLeavesTheHeadAtItsPlaceAndTheFloorLevel) {
    const Pose before = standing_space(some_head(), {2, 0, 3}, 1.1);
    const Pose after = turned_space(before, some_head(), 30);
    expect_place(after * some_head().translation, before * some_head().translation);
    EXPECT_NEAR(heading_of(after * some_head()), 1.1 + radians_of(30), exactly);
    expect_place(rotate(after.rotation, upwards), upwards);
    EXPECT_NEAR(after.translation.y, before.translation.y, exactly);
}

TEST(TrackingSpace, AMoveOfItLeavesTheRoomAtItsRealPlace) {
    const Pose before = standing_space(some_head(), {2, 0, 3}, 1.1);
    const Pose before_from_now{rotation_about(upwards, -0.6), {1, 0, -2}};
    const auto now = moved_space(before, before_from_now);
    ASSERT_TRUE(now);
    const Vec3 there{0.3, 1.2, 0.8};  // in the old space
    expect_place(*now * (inverse(before_from_now) * there), before * there);
}

TEST(TrackingSpace, AMoveThatTiltsTheFloorIsNotBelieved) {
    EXPECT_TRUE(moved_space({}, {rotation_about({0, 0, 1}, radians_of(3)), {}}));
    EXPECT_FALSE(moved_space({}, {rotation_about({0, 0, 1}, radians_of(8)), {}}));
    EXPECT_FALSE(moved_space({}, {{}, {std::nan(""), 0, 0}}));
}

}  // namespace
}  // namespace theatron::xr
