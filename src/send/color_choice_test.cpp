// SPDX-License-Identifier: Apache-2.0
#include "send/color_choice.h"

#include <gtest/gtest.h>

namespace theatron::send {
namespace {

class Choice : public ::testing::Test {
protected:
    // Observes once a second; how often the choice changed.
    int pass(int seconds, const ColorLoad& load) {
        int changes = 0;
        for (int i = 0; i < seconds; ++i)
            changes += choice.observe(load, now += 1s);
        return changes;
    }

    TimePoint now = TimePoint(Duration(1h));
    ColorChoice choice{""};
};

constexpr ColorLoad calm{.busy = 0.3, .h264 = 0.2, .in_use = true, .lost = 0};
constexpr ColorLoad full{.busy = 0.9, .h264 = 0.2, .in_use = true, .lost = 0};

TEST_F(Choice, IsH264WhileTheProcessorIsLessBusyThanTheLimit) {
    EXPECT_FALSE(choice.is_h264()) << "before anything is measured";
    EXPECT_EQ(pass(1, calm), 1);
    EXPECT_TRUE(choice.is_h264());
    EXPECT_EQ(choice.reason(), "H.264: the processor is 30 % busy");
    EXPECT_EQ(pass(600, {.busy = 0.69, .h264 = 0.2, .in_use = true, .lost = 0}), 0);
}

TEST_F(Choice, BeginsOnlyWhereH264WouldFit) {
    EXPECT_EQ(pass(60, {.busy = 0.3, .h264 = 0.5, .in_use = true, .lost = 0}), 0);
    EXPECT_EQ(pass(1, {.busy = 0.3, .h264 = 0.3, .in_use = true, .lost = 0}), 1);
}

TEST_F(Choice, IsJpegWhereThereIsNoEncoder) {
    choice.~ColorChoice();
    new (&choice) ColorChoice("There is no H.264 encoder.");
    EXPECT_EQ(pass(600, calm), 0);
    EXPECT_EQ(choice.reason(), "JPEG of at most 20 Mbit/s a camera: There is no H.264 encoder.");
}

TEST_F(Choice, AShortBurstOfOtherWorkChangesNothing) {
    pass(1, calm);
    for (int i = 0; i < 20; ++i)
        EXPECT_EQ(pass(2, full) + pass(1, calm), 0);
}

TEST_F(Choice, AProcessorThatStaysBusyMeansJpegAndFewTriesMore) {
    pass(1, calm);
    EXPECT_EQ(pass(5, full), 1);
    EXPECT_FALSE(choice.is_h264());
    // H.264 fits as long as it is not encoded, and never when it is.
    int changes = 0;
    for (int second = 0; second < 3600; ++second)
        changes += pass(1, choice.is_h264() ? full : calm);
    EXPECT_LE(changes, 24) << "a try of some seconds every eight minutes at last";
    EXPECT_GE(changes, 10);
}

TEST_F(Choice, LostFramesMeanJpegAtOnceAndASingleOneDoesNot) {
    pass(1, calm);
    ColorLoad load = calm;
    for (int i = 0; i < 100; ++i) {
        load.lost += i % 10 == 0;
        EXPECT_EQ(pass(1, load), 0);
    }
    load.lost += ColorChoice::most_lost;
    EXPECT_EQ(pass(1, load), 1);
    EXPECT_FALSE(choice.is_h264());
    EXPECT_EQ(pass(29, calm), 0);
    ColorLoad later = load;
    EXPECT_EQ(pass(2, later), 1) << "after its pause it is tried again";
}

TEST_F(Choice, WhileNobodyGetsItNothingCountsAsAFailure) {
    ColorLoad unused = full;
    unused.in_use = false;
    unused.lost = 100;
    pass(100, unused);
    EXPECT_FALSE(choice.is_h264());
    unused.busy = 0.2;
    pass(1, unused);
    EXPECT_TRUE(choice.is_h264());
    ColorLoad used = calm;
    used.lost = 100;
    EXPECT_EQ(pass(60, used), 0);
}

}  // namespace
}  // namespace theatron::send
