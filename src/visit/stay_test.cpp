// SPDX-License-Identifier: Apache-2.0
#include "visit/stay.h"

#include <gtest/gtest.h>

#include "phrases/phrase.h"

namespace theatron::visit {
namespace {

client::Participant::Options nobody_answers() {
    client::Participant::Options options;
    options.link = {"127.0.0.1", 1, "token", ""};
    options.remark = [](const std::string&) {};
    return options;
}

class StayTest : public ::testing::Test {
protected:
    KeptSettings settings() {
        return {{}, [this](const client::Settings& now) { kept_.push_back(now); }};
    }

    std::vector<client::Settings> kept_;
};

TEST_F(StayTest, APersonWithoutDevicesIsToldWhatIsMissing) {
    Stay stay(nobody_answers(), {}, settings());
    EXPECT_EQ(stay.obey(ToggleMicrophone{}), say(Phrase::no_microphone_here));
    EXPECT_EQ(stay.obey(SetMicrophone{SetMicrophone::To::open}), say(Phrase::no_microphone_here));
    EXPECT_EQ(stay.obey(TogglePushToTalk{}), say(Phrase::no_microphone_here));
    EXPECT_EQ(stay.obey(ShowFace{}), say(Phrase::no_webcam_here));
    EXPECT_EQ(stay.obey(ShowExpression{true}), say(Phrase::no_tracker_here));
    EXPECT_TRUE(stay.tick(TimePoint{}).empty());
    EXPECT_TRUE(kept_.empty()) << "nothing has changed";
    EXPECT_FALSE(stay.is_over()) << "nobody was in";
}

TEST_F(StayTest, ChoicesOfAPersonAreKept) {
    VoiceLine voice({});
    Stay stay(nobody_answers(), {.voice = &voice}, settings());
    EXPECT_EQ(stay.obey(TogglePushToTalk{}), say(Phrase::push_to_talk));
    ASSERT_EQ(kept_.size(), 1u);
    EXPECT_TRUE(kept_.back().push_to_talk);
    EXPECT_EQ(stay.obey(TogglePushToTalk{}), say(Phrase::open_microphone));
    EXPECT_FALSE(kept_.back().push_to_talk);

    EXPECT_FALSE(stay.participant().voice_may_record());
    EXPECT_EQ(stay.obey(AllowVoiceRecording{}), say(Phrase::host_asks_no_consent))
        << "no host has said that it asks";
    EXPECT_TRUE(stay.participant().voice_may_record());
    EXPECT_TRUE(kept_.back().voice_may_record);
    EXPECT_EQ(stay.obey(AllowVoiceRecording{false}), say(Phrase::voice_may_not_record));
    EXPECT_FALSE(stay.participant().voice_may_record());

    const std::size_t before = kept_.size();
    EXPECT_EQ(stay.obey(AllowVoiceRecording{false}), say(Phrase::voice_may_not_record));
    EXPECT_EQ(kept_.size(), before) << "it was so already";
}

TEST_F(StayTest, AMicrophoneAndALoudspeakerThatAreChosenAreThoseOfTheNextStay) {
    VoiceLine voice({});
    Stay stay(nobody_answers(), {.voice = &voice}, settings());
    EXPECT_EQ(stay.obey(UseMicrophone{"missing/microphone.wav"}),
              say(Phrase::microphone_is_opening));
    EXPECT_EQ(kept_.back().microphone, "missing/microphone.wav");
    EXPECT_TRUE(kept_.back().speaks);
    EXPECT_EQ(stay.obey(UseSpeaker{"missing/speaker.wav"}), "");
    EXPECT_EQ(kept_.back().loudspeaker, "missing/speaker.wav");
    EXPECT_TRUE(kept_.back().hears);
}

TEST_F(StayTest, AFaceIsShownAndHidden) {
    publish::OwnFace face("missing device");
    Stay stay(nobody_answers(), {.face = &face}, settings());
    EXPECT_EQ(stay.obey(ShowFace{}), say(Phrase::webcam_is_opening));
    EXPECT_TRUE(face.is_wanted());
    EXPECT_EQ(stay.obey(ShowFace{}), say(Phrase::webcam_is_off));
    EXPECT_FALSE(face.is_wanted());
}

}  // namespace
}  // namespace theatron::visit
