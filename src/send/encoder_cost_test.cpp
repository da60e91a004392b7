// SPDX-License-Identifier: Apache-2.0
#include "send/encoder_cost.h"

#include <gtest/gtest.h>

namespace theatron::send {
namespace {

EncoderCost costing(Duration cpu, int pictures = 10) {
    EncoderCost cost;
    for (int i = 0; i < pictures; ++i)
        cost.add(cpu);
    return cost;
}

std::vector<std::size_t> chosen(const std::vector<EncoderCost>& costs, Duration share,
                                std::vector<bool> was = {}) {
    was.resize(costs.size());
    std::vector<std::size_t> at_once;
    choose_at_once(costs, was, share, at_once);
    return at_once;
}

using Indices = std::vector<std::size_t>;

TEST(EncoderCost, FollowsWhatIsMeasuredAndForgetsTheFirstPicture) {
    EncoderCost cost;
    EXPECT_FALSE(cost.known());
    cost.add(90ms);  // makes its memory
    EXPECT_FALSE(cost.known());
    cost.add(2ms);
    EXPECT_TRUE(cost.known());
    EXPECT_EQ(cost.typical(), 2ms);
    for (int i = 0; i < 100; ++i)
        cost.add(10ms);
    EXPECT_NEAR(to_ms(cost.typical()), 10, 0.1);
}

TEST(EncoderShare, AllSettingsBesideTheCheapestTakeLessThanHalfOfTheMachine) {
    for (const std::size_t cameras : {1u, 4u, 12u}) {
        const Duration share = encoder_share(30, 2, cameras);
        const double all = 6 * to_seconds(share) * 30 * double(cameras);
        EXPECT_NEAR(all, 2 * 6.0 / share_divisor, 0.02) << cameras;
        EXPECT_LT(all, 1);
    }
}

TEST(ChooseAtOnce, TheCheapestAlwaysAndOthersWithinTheirShare) {
    const auto cheap = costing(1ms), fair = costing(3ms), dear = costing(150ms);
    EXPECT_EQ(chosen({dear}, 4ms), Indices{0});
    EXPECT_EQ(chosen({dear, cheap, fair}, 4ms), (Indices{1, 2})) << "cheapest first";
    EXPECT_EQ(chosen({dear, costing(200ms)}, 4ms), Indices{0});
    EXPECT_EQ(chosen({}, 4ms), Indices{});
}

TEST(ChooseAtOnce, WhatIsNotMeasuredYetMakesNobodyWait) {
    const EncoderCost likely_dear(100ms), likely_cheap(2ms);
    EXPECT_EQ(chosen({costing(1ms), likely_dear}, 4ms), Indices{0});
    EXPECT_EQ(chosen({costing(1ms), likely_cheap}, 4ms), Indices{0}) << "it is measured aside";
    EXPECT_EQ(chosen({likely_dear, costing(150ms)}, 4ms), Indices{0}) << "somebody must begin";
    EXPECT_EQ(chosen({costing(150ms), likely_cheap}, 4ms), Indices{1});
    EXPECT_EQ(chosen({likely_dear, likely_cheap}, 4ms), Indices{1}) << "whatever came first";
}

TEST(ExpectedCost, OrdersSettingsThatWereNeverMeasured) {
    EXPECT_LT(expected_cost("strata"), expected_cost("zstd:delta=1,level=9"));
    EXPECT_LT(expected_cost("zstd:delta=1,level=9"), expected_cost("zstd:delta=1,level=19"));
    EXPECT_LT(expected_cost("jpeg:quality=85"), expected_cost("h264:crf=20"));
    EXPECT_LT(expected_cost("h264:crf=20"), expected_cost("h264:crf=20,preset=veryfast"));
}

TEST(ChooseAtOnce, AtTheEdgeOfItsShareNothingChangesBackAndForth) {
    const auto cheap = costing(1ms), edge = costing(5ms);
    EXPECT_EQ(chosen({cheap, edge}, 4ms, {true, false}), Indices{0});
    EXPECT_EQ(chosen({cheap, edge}, 4ms, {true, true}), (Indices{0, 1}));
}

TEST(KeepingUp, EndsWhenMuchIsLeftOutAndComesBackWhenNothingIs) {
    KeepingUp keeping;
    for (int i = 0; i < 100; ++i)
        EXPECT_FALSE(keeping.on_picture(i % 4 != 0)) << "now and then is not much";
    int changes = 0;
    for (int i = 0; i < 100; ++i)
        changes += keeping.on_picture(i % 5 == 0);
    EXPECT_EQ(changes, 1);
    EXPECT_FALSE(keeping.keeps_up());
    for (int i = 0; i + 1 < KeepingUp::window; ++i)
        EXPECT_FALSE(keeping.on_picture(true));
    EXPECT_FALSE(keeping.keeps_up());
    EXPECT_TRUE(keeping.on_picture(true));
    EXPECT_TRUE(keeping.keeps_up());
}

}  // namespace
}  // namespace theatron::send
