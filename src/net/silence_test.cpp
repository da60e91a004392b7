// SPDX-License-Identifier: Apache-2.0
#include "net/silence.h"

#include <gtest/gtest.h>

namespace theatron::net {
namespace {

TEST(Silence, CountsFromTheFirstMessageThatNothingFollowed) {
    Silence silence;
    TimePoint now = from_us(5'000'000);
    silence.sent(now);
    for (int i = 0; i < 30; ++i)
        silence.sent(now += 1s);
    EXPECT_FALSE(silence.is_too_long(now));
    EXPECT_TRUE(silence.is_too_long(now + 1s));
    silence.heard();
    EXPECT_FALSE(silence.is_too_long(now + 1s));
}

TEST(Silence, OfAHostThatWasAskedNothingIsNoLoss) {
    Silence silence;
    EXPECT_FALSE(silence.is_too_long(from_us(1) + 1h));
    silence.sent(from_us(1));
    silence.heard();
    EXPECT_FALSE(silence.is_too_long(from_us(1) + 1h));
}

TEST(Silence, ASleepIsTimeThatTheSteadyClockDidNotCount) {
    Silence silence;
    const TimePoint now = from_us(5'000'000), wall = from_us(1'700'000'000'000'000);
    EXPECT_FALSE(silence.has_slept(now, wall));
    // A hidden page that is called once a minute; a clock that is set back.
    EXPECT_FALSE(silence.has_slept(now + 60s, wall + 60s));
    EXPECT_FALSE(silence.has_slept(now + 61s, wall - 1h));
    EXPECT_TRUE(silence.has_slept(now + 62s, wall - 1h + 12s));
    EXPECT_FALSE(silence.has_slept(now + 63s, wall - 1h + 13s));
}

}  // namespace
}  // namespace theatron::net
