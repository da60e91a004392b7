// SPDX-License-Identifier: Apache-2.0
#include "face/voice_mouth.h"

#include <gtest/gtest.h>

namespace theatron::face {
namespace {

constexpr int silence_db = -127;

class VoiceMouthTest : public testing::Test {
protected:
    // The mouth after this long at this level.
    float after(int level_db, Duration time) {
        float open = 0;
        for (const TimePoint end = now + time; now < end; now += 16ms)
            open = mouth.put(level_db, now);
        return open;
    }

    VoiceMouth mouth;
    TimePoint now{};
};

TEST_F(VoiceMouthTest, ItIsClosedInSilenceAndOpensWithTheVoice) {
    EXPECT_EQ(after(silence_db, 1s), 0);
    EXPECT_EQ(after(VoiceMouth::quiet_db, 1s), 0) << "a quiet room is no voice";
    const float usual = after(-30, 1s), loud = after(-18, 1s);
    EXPECT_GT(usual, 0.2F);
    EXPECT_GT(loud, usual + 0.1F);
    EXPECT_LE(after(0, 1s), VoiceMouth::widest);
}

TEST_F(VoiceMouthTest, ItFollowsSyllablesWithoutAJerk) {
    EXPECT_GT(after(-20, 100ms), 0.8F * after(-20, 1s));
    EXPECT_LT(after(silence_db, 300ms), 0.05F);
    float last = mouth.put(silence_db, now);
    for (int i = 0; i < 100; ++i) {
        now += 16ms;
        const float open = mouth.put(i % 10 < 5 ? -18 : silence_db, now);
        EXPECT_LT(std::abs(open - last), 0.25F);
        last = open;
    }
}

TEST_F(VoiceMouthTest, TheRateOfItsStepsDoesNotMatter) {
    VoiceMouth slow;
    slow.put(-20, now);
    mouth.put(-20, now);
    for (int i = 0; i < 10; ++i)
        mouth.put(-20, now + (i + 1) * 10ms);
    EXPECT_NEAR(slow.put(-20, now + 100ms), mouth.put(-20, now + 100ms), 1e-3);
}

TEST(IdleBlink, LidsCloseForAMomentInEachSpan) {
    int blinks = 0;
    float last = 0, most = 0;
    double closed_s = 0;
    for (double t = 0; t < 120; t += 0.01) {
        const float lid = idle_blink(t);
        EXPECT_TRUE(lid >= 0 && lid <= 1);
        blinks += last == 0 && lid > 0;
        closed_s += lid > 0.5F ? 0.01 : 0;
        most = std::max(most, lid);
        last = lid;
    }
    EXPECT_EQ(blinks, 30);
    EXPECT_GT(most, 0.9F);
    EXPECT_LT(closed_s, 5);
}

}  // namespace
}  // namespace theatron::face
