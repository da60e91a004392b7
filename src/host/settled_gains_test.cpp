// SPDX-License-Identifier: Apache-2.0
#include "host/settled_gains.h"

#include <gtest/gtest.h>

namespace theatron::host {
namespace {

using Gains = SettledGains::Gains;

Gains of_two(double a, double b) {
    return {Vec3{a, a, a}, Vec3{b, b, b}};
}

class SettledGainsTest : public ::testing::Test {
protected:
    // One estimate every ten seconds; the gains that are published meanwhile, and how often.
    Gains give(const Gains& estimate, Duration length) {
        Gains newest;
        for (const TimePoint end = now_ + length; now_ < end; now_ += 10s)
            if (const Gains published = gains_.add(estimate, now_); !published.empty()) {
                newest = published;
                ++times_;
            }
        return newest;
    }

    SettledGains gains_;
    TimePoint now_ = from_us(1'000'000);
    int times_ = 0;
};

TEST_F(SettledGainsTest, AreTheMeanOfEstimatesThatAgree) {
    EXPECT_TRUE(gains_.add(of_two(1.2, 0.8), now_).empty());
    EXPECT_TRUE(gains_.add(of_two(1.196, 0.8), now_).empty());
    EXPECT_TRUE(gains_.add(of_two(1.204, 0.802), now_).empty());
    EXPECT_FALSE(gains_.has_published());
    EXPECT_EQ(gains_.add(of_two(1.2, 0.806), now_), of_two(1.2, 0.802));
    EXPECT_EQ(gains_.published(), of_two(1.2, 0.802));
}

TEST_F(SettledGainsTest, ArePublishedOnceWhileNothingChanges) {
    EXPECT_EQ(give(of_two(1.2, 0.8), 1h), of_two(1.2, 0.8));
    EXPECT_EQ(times_, 1);
    EXPECT_TRUE(give(of_two(1.23, 0.79), 1h).empty()) << "nobody sees that";
}

TEST_F(SettledGainsTest, WaitForEstimatesThatDisagree) {
    for (int i = 0; i < 100; ++i)
        EXPECT_TRUE(gains_.add(of_two(1 + 0.02 * (i % 3), 1), now_).empty());
}

TEST_F(SettledGainsTest, FollowAChangeThatStays) {
    (void)give(of_two(1.2, 0.8), 1min);
    EXPECT_TRUE(give(of_two(1.3, 0.7), SettledGains::lasting).empty());
    EXPECT_EQ(give(of_two(1.3, 0.7), 10s), of_two(1.3, 0.7));
    EXPECT_EQ(times_, 2);
    EXPECT_TRUE(give(of_two(1.3, 0.7), 1h).empty());
}

TEST_F(SettledGainsTest, OutliveAChangeThatPasses) {
    (void)give(of_two(1.2, 0.8), 1min);
    for (int i = 0; i < 20; ++i) {
        EXPECT_TRUE(give(of_two(1.3, 0.7), SettledGains::lasting).empty());
        EXPECT_TRUE(give(of_two(1.2, 0.8), 10s).empty());
    }
    EXPECT_EQ(gains_.published(), of_two(1.2, 0.8));
}

TEST_F(SettledGainsTest, WaitWhileAChangeGoesOn) {
    (void)give(of_two(1, 1), 1min);
    for (int i = 0; i < 60; ++i)
        EXPECT_TRUE(give(of_two(1 + 0.01 * i, 1), 10s).empty());
    EXPECT_NEAR(give(of_two(1.6, 1), 2min).at(0)->x, 1.6, 0.005);
}

TEST_F(SettledGainsTest, OfACameraThatIsComparedWithNoneStayAsTheyAre) {
    (void)give(of_two(1.2, 0.8), 1min);
    EXPECT_TRUE(give({std::nullopt, std::nullopt}, 1h).empty());
    const Gains changed = give({std::nullopt, Vec3{1, 1, 1}}, 10min);
    EXPECT_EQ(changed, (Gains{std::nullopt, Vec3{1, 1, 1}}));
    EXPECT_EQ(gains_.published(), of_two(1.2, 1));
}

TEST_F(SettledGainsTest, ComeLaterForACameraThatIsComparedLater) {
    (void)give({Vec3{1.2, 1.2, 1.2}, std::nullopt}, 1min);
    EXPECT_EQ(give(of_two(1.2, 1), 2min), of_two(1.2, 1));
}

}  // namespace
}  // namespace theatron::host
