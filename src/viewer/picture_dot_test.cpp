// SPDX-License-Identifier: Apache-2.0
#include "viewer/picture_dot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testing/speaking.h"

namespace theatron::viewer {
namespace {

using Level = window::PictureDot::Level;
using Phase = client::Participant::Phase;

DotFacts live_dot() {
    DotFacts facts;
    facts.has_picture = true;
    facts.age_ms = 60;
    return facts;
}

TEST(PictureDot, ALivePictureIsGreenWithItsAge) {
    EXPECT_EQ(picture_dot(live_dot()).level, Level::good);
    EXPECT_EQ(picture_dot(live_dot()).words, "Live 0.1 s");
    DotFacts unknown = live_dot();
    unknown.age_ms.reset();
    EXPECT_EQ(picture_dot(unknown).level, Level::good);
    EXPECT_EQ(picture_dot(unknown).words, "Live");
}

TEST(PictureDot, SpeaksTheLanguageOfItsPerson) {
    DotFacts facts = live_dot();
    facts.age_ms = 812;
    {
        const testing::Speaking german(Language::german);
        EXPECT_EQ(picture_dot(facts).words, "Live 0,8 s");
    }
    const testing::Speaking french(Language::french);
    EXPECT_EQ(picture_dot(facts).words, "Direct 0,8 s");
    facts.age_ms = 12'300;
    EXPECT_EQ(picture_dot(facts).words, "Il y a 12 s");
}

TEST(PictureDot, ALatePictureIsYellowAndAnOldOneRed) {
    DotFacts facts = live_dot();
    facts.age_ms = 800;
    EXPECT_EQ(picture_dot(facts).level, Level::slow);
    facts.age_ms = 12'300;
    EXPECT_EQ(picture_dot(facts).level, Level::bad);
    EXPECT_EQ(picture_dot(facts).words, "12 s old");
}

TEST(PictureDot, NothingOfAnotherTimeLooksLive) {
    DotFacts facts = live_dot();
    facts.is_of_another_time = true;
    EXPECT_EQ(picture_dot(facts).level, Level::bad);
    EXPECT_EQ(picture_dot(facts).words, "Not live");
    facts = live_dot();
    facts.is_missing_a_camera = true;
    EXPECT_EQ(picture_dot(facts).level, Level::bad);
}

TEST(PictureDot, UnrestAndSlownessAreSigns) {
    DotFacts facts = live_dot();
    facts.is_late = true;
    EXPECT_EQ(picture_dot(facts).level, Level::slow);
    facts = live_dot();
    facts.unrest = 7;
    EXPECT_EQ(picture_dot(facts).level, Level::slow);
    EXPECT_THAT(picture_dot(facts).hint, ::testing::HasSubstr("7 times"));
}

TEST(PictureDot, WithoutAConnectionItIsNeverGreen) {
    DotFacts facts = live_dot();
    for (const Phase phase :
         {Phase::connecting, Phase::waiting, Phase::lost, Phase::refused, Phase::ended}) {
        facts.phase = phase;
        EXPECT_NE(picture_dot(facts).level, Level::good);
    }
}

}  // namespace
}  // namespace theatron::viewer
