// SPDX-License-Identifier: Apache-2.0
#include "voice/speakers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "voice/packet.h"

namespace theatron::voice {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr ParticipantId anna{3}, ben{4};

TimePoint at_ms(int ms) {
    return TimePoint(std::chrono::hours(1) + std::chrono::milliseconds(ms));
}

Bytes packet(int level_db) {
    static const Bytes opus(20, std::byte{7});
    voice::Packet packet;
    packet.level_db = level_db;
    packet.opus = opus;
    Bytes bytes;
    voice::write_packet(packet, bytes);
    return bytes;
}

// Frames of 20 ms.
void say(Speakers& speakers, ParticipantId who, int from_ms, int to_ms, int level_db) {
    for (int ms = from_ms; ms < to_ms; ms += 20)
        speakers.hear(who, packet(level_db), at_ms(ms));
}

TEST(Speakers, TheLevelIsThatOfTheNewestPacketAlsoBetweenWords) {
    Speakers speakers;
    say(speakers, anna, 0, 1000, -20);
    EXPECT_EQ(speakers.levels_db(at_ms(1000)), (std::map<ParticipantId, int>{{anna, -20}}));
    say(speakers, anna, 1000, 1100, -90);
    say(speakers, ben, 1000, 1100, -90);
    EXPECT_EQ(speakers.levels_db(at_ms(1100)), (std::map<ParticipantId, int>{{anna, -90}}));
    EXPECT_TRUE(speakers.levels_db(at_ms(3000)).empty());
}

TEST(Speakers, APersonSpeaksFromTheFirstWordsUntilAPause) {
    Speakers speakers;
    say(speakers, anna, 0, 1000, -20);
    EXPECT_THAT(speakers.speaking(at_ms(1000)), ElementsAre(anna));
    EXPECT_THAT(speakers.speaking(at_ms(1700)), ElementsAre(anna));
    EXPECT_THAT(speakers.speaking(at_ms(2000)), IsEmpty());
    say(speakers, ben, 2000, 2600, -30);
    EXPECT_THAT(speakers.speaking(at_ms(2600)), ElementsAre(ben));
}

TEST(Speakers, BreathAndKnocksAreNoSpeech) {
    Speakers speakers;
    say(speakers, anna, 0, 1000, -60);
    say(speakers, ben, 500, 580, -10);
    EXPECT_THAT(speakers.speaking(at_ms(1000)), IsEmpty());
    // Another knock after a pause is not the end of a long word.
    say(speakers, ben, 3000, 3080, -10);
    EXPECT_THAT(speakers.speaking(at_ms(3080)), IsEmpty());
}

TEST(Speakers, SeveralPeopleSpeakAtOnce) {
    Speakers speakers;
    say(speakers, anna, 0, 600, -20);
    say(speakers, ben, 300, 900, -20);
    EXPECT_THAT(speakers.speaking(at_ms(900)), ElementsAre(anna, ben));
}

TEST(Speakers, DamagedPacketsAreSkipped) {
    Speakers speakers;
    for (int ms = 0; ms < 1000; ms += 20)
        speakers.hear(anna, Bytes(5), at_ms(ms));
    EXPECT_THAT(speakers.speaking(at_ms(1000)), IsEmpty());
}

TEST(Speakers, MorePeopleThanAreRememberedSpeakOneAfterTheOther) {
    Speakers speakers;
    for (int id = 1; id < 200; ++id) {
        say(speakers, ParticipantId(id), 2000 * id, 2000 * id + 500, -20);
        EXPECT_THAT(speakers.speaking(at_ms(2000 * id + 500)), ElementsAre(ParticipantId(id)));
    }
}

}  // namespace
}  // namespace theatron::voice
