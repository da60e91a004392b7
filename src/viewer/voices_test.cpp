// SPDX-License-Identifier: Apache-2.0
#include "viewer/voices.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

TEST(Voices, TheMeterGrowsWithTheLevelAndKeepsItsWidth) {
    EXPECT_EQ(meter_text(-127), ".....");
    EXPECT_EQ(meter_text(-51), ".....");
    EXPECT_EQ(meter_text(-50), "|....");
    EXPECT_EQ(meter_text(-25), "|||..");
    EXPECT_EQ(meter_text(0), "|||||");
}

TEST(Voices, TheMicrophoneFactSaysWhyNobodyHearsThePerson) {
    Voices voices;
    wire::Standing standing;
    standing.role = wire::Role::expert;
    EXPECT_FALSE(microphone_fact(voices, standing)) << "a window without voice";
    voices.microphone = Microphone::open;
    voices.own_level_db = -25;
    EXPECT_EQ(microphone_fact(voices, standing)->value, "open |||..");
    EXPECT_FALSE(microphone_fact(voices, standing)->warning);
    standing.muted = true;
    EXPECT_EQ(microphone_fact(voices, standing)->value, "open, but an operator has muted you");
    EXPECT_TRUE(microphone_fact(voices, standing)->warning);
    standing = {};
    standing.role = wire::Role::observer;
    EXPECT_EQ(microphone_fact(voices, standing)->value, "open, but observers are not heard");
    voices.microphone = Microphone::missing;
    EXPECT_TRUE(microphone_fact(voices, standing)->warning);
    voices.microphone = Microphone::closed;
    EXPECT_EQ(microphone_fact(voices, standing)->value, "closed, L opens it");
    voices.microphone = Microphone::waits;
    standing.role = wire::Role::expert;
    EXPECT_EQ(microphone_fact(voices, standing)->value, "hold Enter to speak");
    voices.microphone = Microphone::none;
    EXPECT_FALSE(microphone_fact(voices, standing)) << "listening is no fault";
}

TEST(Voices, InARecordedSessionThePersonSeesIfItsVoiceIsRecorded) {
    Voices voices;
    voices.microphone = Microphone::open;
    EXPECT_FALSE(recorded_voice_fact(voices)) << "the host is too old to ask";
    voices.may_record = false;
    EXPECT_FALSE(recorded_voice_fact(voices)->warning);
    voices.may_record = true;
    EXPECT_TRUE(recorded_voice_fact(voices)->warning);
    voices.microphone = Microphone::none;
    EXPECT_FALSE(recorded_voice_fact(voices)) << "it only listens";
}

}  // namespace
}  // namespace theatron::viewer
