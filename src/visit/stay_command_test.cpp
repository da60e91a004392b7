// SPDX-License-Identifier: Apache-2.0
#include "visit/stay_command.h"

#include <gtest/gtest.h>

namespace theatron::visit {
namespace {

using Microphone = SetMicrophone::To;

TEST(StayCommand, OfLines) {
    const auto of = [](const char* line) { return stay_command(std::string(line)); };
    EXPECT_EQ(of("microphone off"), StayCommand(SetMicrophone{Microphone::closed}));
    EXPECT_EQ(of("microphone on"), StayCommand(SetMicrophone{Microphone::open}));
    EXPECT_EQ(of(" microphone   push "), StayCommand(SetMicrophone{Microphone::push_to_talk}));
    EXPECT_EQ(of("talk on"), StayCommand(HoldTalk{true}));
    EXPECT_EQ(of("use microphone"), StayCommand(UseMicrophone{"default"}));
    EXPECT_EQ(of("use speaker USB head set"), StayCommand(UseSpeaker{"USB head set"}));
    EXPECT_EQ(of("voice-recording off"), StayCommand(AllowVoiceRecording{false}));
    EXPECT_EQ(of("webcam on"), StayCommand(ShowFace{true}));
    EXPECT_EQ(of("face off"), StayCommand(ShowExpression{false}));
    for (const char* other : {"", "microphone", "microphone loud", "microphone on now", "talk push",
                              "use camera 1", "webcam", "face on please", "depth rvl", "quit"})
        EXPECT_EQ(of(other), std::nullopt) << other;
}

TEST(StayCommand, OfKeysAndThePanelOfDevices) {
    using window::Action;
    EXPECT_EQ(stay_command(Action::microphone), StayCommand(ToggleMicrophone{}));
    EXPECT_EQ(stay_command(Action::push_to_talk), StayCommand(TogglePushToTalk{}));
    EXPECT_EQ(stay_command(Action::voice_recording), StayCommand(AllowVoiceRecording{}));
    EXPECT_EQ(stay_command(Action::own_face), StayCommand(ShowFace{}));
    EXPECT_EQ(stay_command(Action::help), std::nullopt);
    EXPECT_EQ(stay_command(viewer::UseSound{viewer::UseSound::Kind::microphone, "a"}),
              StayCommand(UseMicrophone{"a"}));
    EXPECT_EQ(stay_command(viewer::UseSound{viewer::UseSound::Kind::loudspeaker, "b"}),
              StayCommand(UseSpeaker{"b"}));
}

}  // namespace
}  // namespace theatron::visit
