// SPDX-License-Identifier: Apache-2.0
#include "capture/steady_times.h"

#include <gtest/gtest.h>

namespace theatron::capture {
namespace {

using namespace std::chrono_literals;

TEST(SteadyTimes, APictureIsDueAsLongAfterTheFirstAsTheFileSays) {
    SteadyTimes times;
    EXPECT_EQ(times.due(5s, 40ms), Duration(0));
    EXPECT_EQ(times.due(5040ms, 40ms), 40ms);
    EXPECT_EQ(times.due(15min, 40ms), 15min - 5s);
    EXPECT_FALSE(times.jumped());
}

TEST(SteadyTimes, AfterAJumpTheNextPictureFollowsByOnePeriod) {
    SteadyTimes times;
    (void)times.due(1s, 40ms);
    EXPECT_EQ(times.due(24h, 40ms), 40ms);
    EXPECT_EQ(times.due(24h + 30ms, 40ms), 70ms);
    EXPECT_TRUE(times.jumped());
}

TEST(SteadyTimes, TimesThatGoBackAreThoseOfThePictureBefore) {
    SteadyTimes times;
    (void)times.due(1s, 40ms);
    EXPECT_EQ(times.due(2s, 40ms), 1s);
    EXPECT_EQ(times.due(500ms, 40ms), 1s);
    EXPECT_EQ(times.due(2100ms, 40ms), 1100ms);
    EXPECT_FALSE(times.jumped());
}

}  // namespace
}  // namespace theatron::capture
