// SPDX-License-Identifier: Apache-2.0
#include "pace/drawing_watch.h"

#include <gtest/gtest.h>

namespace theatron::pace {
namespace {

constexpr TimePoint drawing_began{100s};

TEST(DrawingWatch, NothingIsCoveredBeforeTheFirstPicture) {
    EXPECT_FALSE(DrawingWatch().still(drawing_began + 1h));
}

TEST(DrawingWatch, WhatIsDrawnInTimeIsNotCovered) {
    DrawingWatch watch;
    for (TimePoint now = drawing_began; now < drawing_began + 60s; now += 1999ms) {
        EXPECT_FALSE(watch.still(now));
        watch.beat(now);
    }
}

TEST(DrawingWatch, WhatStandsStillIsCoveredFromTwoSecondsOnUntilItIsDrawnAgain) {
    DrawingWatch watch;
    watch.beat(drawing_began);
    EXPECT_FALSE(watch.still(drawing_began + 1999ms));
    EXPECT_EQ(watch.still(drawing_began + 2s), std::optional<Duration>(2s));
    EXPECT_EQ(watch.still(drawing_began + 9s), std::optional<Duration>(9s));
    watch.beat(drawing_began + 9s);
    EXPECT_FALSE(watch.still(drawing_began + 10s));
}

TEST(DrawingWatch, AFormIsNotCoveredHoweverLongItStands) {
    DrawingWatch watch;
    watch.beat(drawing_began);
    watch.rest();
    EXPECT_FALSE(watch.still(drawing_began + 1h));
    watch.beat(drawing_began + 1h);
    EXPECT_TRUE(watch.still(drawing_began + 1h + 3s));
}

}  // namespace
}  // namespace theatron::pace
