// SPDX-License-Identifier: Apache-2.0
#include "session/request_budget.h"

#include <gtest/gtest.h>

namespace theatron::session {
namespace {

using Kind = RequestBudget::Kind;
using Answer = RequestBudget::Answer;

constexpr const RequestBudget::Limit& limit_of(Kind kind) {
    return RequestBudget::limits[std::size_t(kind)];
}

TEST(TokenBucket, GivesWhatItHoldsAndFillsWithTime) {
    TokenBucket bucket(2, 3);
    TimePoint now = from_us(5'000'000);
    for (int i = 0; i < 3; ++i)
        EXPECT_TRUE(bucket.take(now));
    EXPECT_FALSE(bucket.take(now));
    EXPECT_FALSE(bucket.take(now + 499ms));
    EXPECT_TRUE(bucket.take(now + 500ms));
    EXPECT_FALSE(bucket.take(now + 500ms));
    now += std::chrono::hours(1);
    for (int i = 0; i < 3; ++i)
        EXPECT_TRUE(bucket.take(now));
    EXPECT_FALSE(bucket.take(now)) << "it holds no more than three";
}

TEST(TokenBucket, TimeThatRunsBackwardsFillsNothing) {
    TokenBucket bucket(1, 1);
    EXPECT_TRUE(bucket.take(from_us(9'000'000)));
    EXPECT_FALSE(bucket.take(from_us(1'000'000)));
    EXPECT_FALSE(bucket.take(from_us(9'500'000)));
    EXPECT_TRUE(bucket.take(from_us(10'000'000)));
}

TEST(RequestBudget, EachKindHasItsOwnLimit) {
    RequestBudget budget(1);
    const TimePoint now = from_us(1);
    for (int i = 0; i < limit_of(Kind::codecs).at_once; ++i)
        EXPECT_EQ(budget.ask(Kind::codecs, now), Answer::granted);
    EXPECT_EQ(budget.ask(Kind::codecs, now), Answer::too_often);
    EXPECT_EQ(budget.ask(Kind::ping, now), Answer::granted);
    EXPECT_EQ(budget.refused(), 1u);
}

TEST(RequestBudget, KeyFramesMayBeAskedForOfEveryStream) {
    constexpr std::size_t streams = 24;
    RequestBudget budget(streams);
    for (std::size_t i = 0; i < streams * std::size_t(limit_of(Kind::key).at_once); ++i)
        EXPECT_EQ(budget.ask(Kind::key, from_us(1)), Answer::granted);
    EXPECT_EQ(budget.ask(Kind::key, from_us(1)), Answer::too_often);
}

// A key held down repeats 30 times a second.
TEST(RequestBudget, AnImpatientPersonIsNotAFlood) {
    RequestBudget budget(2);
    TimePoint now = from_us(0);
    int granted = 0;
    for (int i = 0; i < 30 * 600; ++i, now += 33ms) {
        const Answer answer = budget.ask(Kind::codecs, now);
        ASSERT_NE(answer, Answer::flood);
        granted += answer == Answer::granted;
    }
    EXPECT_NEAR(granted, to_seconds(now - from_us(0)) * limit_of(Kind::codecs).per_second, 6);
}

TEST(RequestBudget, AFloodIsOneAfterAStatedNumber) {
    RequestBudget budget(2);
    int asked = 0;
    while (budget.ask(Kind::ping, from_us(1)) != Answer::flood)
        ++asked;
    EXPECT_EQ(asked, limit_of(Kind::ping).at_once + RequestBudget::patience.at_once);
}

}  // namespace
}  // namespace theatron::session
