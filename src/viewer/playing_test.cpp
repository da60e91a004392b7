// SPDX-License-Identifier: Apache-2.0
#include "viewer/playing.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

TEST(PlaybackText, SaysThatItIsARecordingAndWhoPausedIt) {
    using std::chrono::seconds;
    wire::Playback playback{seconds(10), from_us(5'000'000), seconds(62), false, "Anna"};
    const TimePoint now = from_us(7'000'000);
    EXPECT_EQ(playback_text(playback, now), "RECORDING 0:12 / 1:02");
    playback.paused = true;
    EXPECT_EQ(playback_text(playback, now), "RECORDING 0:10 / 1:02, paused by Anna");
    playback = {seconds(62), from_us(5'000'000), seconds(62), true, ""};
    EXPECT_EQ(playback_text(playback, now), "RECORDING 1:02 / 1:02, paused at its end");
}

}  // namespace
}  // namespace theatron::viewer
