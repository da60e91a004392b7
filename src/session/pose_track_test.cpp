// SPDX-License-Identifier: Apache-2.0
#include "session/pose_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <random>

namespace theatron::session {
namespace {

using std::chrono::milliseconds;

TimePoint at_ms(double ms) {
    return TimePoint(Duration(std::int64_t(ms * 1000)));
}

wire::PersonPose head_at(double ms, Vec3 place, double turn = 0) {
    wire::PersonPose pose;
    pose.time = at_ms(ms);
    pose.head = wire::PartPose{{float(place.x), float(place.y), float(place.z)},
                               {float(std::cos(turn / 2)), 0, float(std::sin(turn / 2)), 0}};
    return pose;
}

// A head that moves back and forth by a metre in two seconds.
Vec3 swaying(double ms) {
    return {0.5 * std::sin(ms / 1000 * 3.14159), 1.6, 0};
}

TEST(PoseTrack, IsEmptyBeforeTheFirstPose) {
    EXPECT_FALSE(PoseTrack().at(at_ms(5)));
    EXPECT_FALSE(PoseTrack().is_moving(at_ms(5)));
}

TEST(PoseTrack, ShowsEachMomentBetweenPoses) {
    PoseTrack track;
    for (int ms = 0; ms <= 300; ms += 30)
        track.add(head_at(ms, {ms / 1000.0, 0, 0}, ms / 1000.0), at_ms(ms + 5));
    // The delay is one interval and the 5 ms of travel.
    EXPECT_EQ(track.delay(), milliseconds(35));
    const auto pose = track.at(at_ms(320));
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->head->position[0], 0.285, 1e-4);
    EXPECT_NEAR(2 * std::atan2(pose->head->rotation[2], pose->head->rotation[0]), 0.285, 1e-3);
}

TEST(PoseTrack, MotionIsSmoothAlthoughPosesArriveUnevenly) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> late(2, 40);
    PoseTrack track;
    std::deque<std::pair<double, wire::PersonPose>> arriving;
    double arrived = 0, previous_x = NAN, worst_step = 0, worst_error = 0;
    for (int ms = 0; ms < 4000; ++ms) {
        if (ms % 11 == 0) {
            arrived = std::max(arrived, ms + late(random));
            arriving.emplace_back(arrived, head_at(ms, swaying(ms)));
        }
        while (!arriving.empty() && arriving.front().first <= ms) {
            track.add(arriving.front().second, at_ms(ms));
            arriving.pop_front();
        }
        if (ms < 1000)
            continue;
        const double x = track.at(at_ms(ms))->head->position[0];
        if (!std::isnan(previous_x))
            worst_step = std::max(worst_step, std::abs(x - previous_x));
        previous_x = x;
        const double shown = ms - double(track.delay().count()) / 1000;
        worst_error = std::max(worst_error, std::abs(x - swaying(shown).x));
    }
    // The head moves by at most 1.6 mm in a millisecond; a delay that grows holds it back, and the
    // newest poses may be extrapolated by some milliseconds until then.
    EXPECT_LT(worst_step, 0.006);
    EXPECT_LT(worst_error, 0.003);
}

TEST(PoseTrack, GoesOnBrieflyAndThenStops) {
    PoseTrack track;
    for (int ms = 0; ms <= 100; ms += 10)
        track.add(head_at(ms, {ms / 1000.0, 0, 0}), at_ms(ms));
    const double at_50 = track.at(at_ms(150) + track.delay())->head->position[0];
    EXPECT_NEAR(at_50, 0.15, 1e-4);
    EXPECT_TRUE(track.is_moving(at_ms(150)));
    const double at_500 = track.at(at_ms(600) + track.delay())->head->position[0];
    EXPECT_NEAR(at_500, 0.2, 1e-4);
    EXPECT_FALSE(track.is_moving(at_ms(600)));
}

TEST(PoseTrack, ATeleportIsNotInterpolated) {
    PoseTrack track;
    track.add(head_at(0, {0, 1.6, 0}), at_ms(0));
    track.add(head_at(20, {0, 1.6, 0}), at_ms(20));
    track.add(head_at(40, {3, 1.6, 1}), at_ms(40));
    for (int ms = 20; ms < 120; ++ms) {
        const double x = track.at(at_ms(ms))->head->position[0];
        EXPECT_TRUE(std::abs(x) < 1e-6 || std::abs(x - 3) < 1e-6) << x;
    }
    ASSERT_TRUE(track.teleport());
    EXPECT_EQ(track.teleport()->at, at_ms(40));
    EXPECT_NEAR(track.teleport()->to.x, 3, 1e-6);
}

TEST(PoseTrack, OldPosesAreIgnored) {
    PoseTrack track;
    track.add(head_at(50, {1, 0, 0}), at_ms(50));
    track.add(head_at(20, {2, 0, 0}), at_ms(60));
    EXPECT_EQ(track.newest(), at_ms(50));
    EXPECT_NEAR(track.at(at_ms(70))->head->position[0], 1, 1e-6);
}

}  // namespace
}  // namespace theatron::session
