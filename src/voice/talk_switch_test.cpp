// SPDX-License-Identifier: Apache-2.0
#include "voice/talk_switch.h"

#include <gtest/gtest.h>

namespace theatron::voice {
namespace {

TEST(TalkSwitch, AnOpenMicrophoneTalksUntilItIsClosed) {
    TalkSwitch microphone(false);
    EXPECT_TRUE(microphone.talks());
    microphone.set_open(false);
    EXPECT_FALSE(microphone.talks());
    microphone.hold(true, from_us(0));
    EXPECT_FALSE(microphone.talks()) << "the key opens no closed microphone";
}

TEST(TalkSwitch, PushToTalkTalksWhileTheKeyIsHeldAndShortlyAfter) {
    TalkSwitch microphone(true);
    EXPECT_FALSE(microphone.talks());
    microphone.hold(true, from_us(1'000'000));
    EXPECT_TRUE(microphone.talks());
    microphone.hold(true, from_us(2'000'000));
    microphone.hold(false, from_us(2'199'000));
    EXPECT_TRUE(microphone.talks());
    microphone.hold(false, from_us(2'200'000));
    EXPECT_FALSE(microphone.talks());
    // The release counts from the last time at which the key was held.
    microphone.hold(false, from_us(2'201'000));
    EXPECT_FALSE(microphone.talks());
    microphone.set_pushes(false);
    EXPECT_TRUE(microphone.talks());
}

}  // namespace
}  // namespace theatron::voice
