// SPDX-License-Identifier: Apache-2.0
// From a microphone's samples to a loudspeaker's.
#include "voice/talker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "voice/mixer.h"

namespace theatron::voice {
namespace {

constexpr ParticipantId alice{1}, bob{2};

// A tone, or silence, of one block of 10 ms.
std::vector<float> block_of(bool sounds, double hz, int block) {
    std::vector<float> samples(480);
    for (std::size_t i = 0; sounds && i < samples.size(); ++i)
        samples[i] = float(0.3 * std::sin(2 * std::numbers::pi * hz *
                                          (double(block) * 480 + double(i)) / sample_rate));
    return samples;
}

double power_of(std::span<const float> samples) {
    double sum = 0;
    for (const float v : samples)
        sum += double(v) * double(v);
    return sum / double(samples.size());
}

TEST(Talker, SilenceSendsNextToNothingAndVoiceEveryFrame) {
    std::vector<Packet> packets;
    Talker talker(20, [&](ByteView bytes) { packets.push_back(*parse_packet(bytes)); });
    TimePoint now;
    const auto say = [&](bool sounds, int blocks) {
        packets.clear();
        for (int i = 0; i < blocks; ++i)
            talker.take(block_of(sounds, 300, i), now += 10ms);
        return packets.size();
    };
    EXPECT_EQ(say(true, 200), 100u);
    EXPECT_EQ(packets.back().number, 99u);
    EXPECT_EQ(packets.back().time, now - 20ms);
    EXPECT_NEAR(packets.back().level_db, -13, 1);
    say(false, 100);
    EXPECT_LE(say(false, 1000), 60u) << "of 500 frames of silence";
    EXPECT_GE(say(true, 100), 50u);
}

TEST(Talker, AClosedMicrophoneSendsNothingThatIsSaid) {
    std::vector<Packet> packets;
    Talker talker(10, [&](ByteView bytes) { packets.push_back(*parse_packet(bytes)); });
    TimePoint now;
    talker.take(block_of(true, 300, 0), now += 10ms);
    talker.set_open(false);
    packets.clear();
    for (int i = 0; i < 100; ++i)
        talker.take(block_of(true, 300, i), now += 10ms);
    ASSERT_EQ(packets.size(), 1u);
    EXPECT_TRUE(packets[0].pauses);
    EXPECT_EQ(packets[0].level_db, -127);
    talker.set_open(true);
    talker.take(block_of(true, 300, 0), now += 10ms);
    EXPECT_EQ(packets.size(), 2u);
    EXPECT_EQ(packets.back().number, 101u);
}

TEST(Mixer, TwoVoicesAreHeardTogetherAndThePauseOfOneIsSeen) {
    Mixer mixer;
    TimePoint now;
    Talker a(20, [&](ByteView bytes) { mixer.put(alice, bytes, now); });
    Talker b(20, [&](ByteView bytes) { mixer.put(bob, bytes, now); });
    std::vector<float> out(480);
    const auto run = [&](bool a_sounds, bool b_sounds) {
        double power = 0;
        for (int i = 0; i < 200; ++i) {
            now += 10ms;
            a.take(block_of(a_sounds, 300, i), now);
            b.take(block_of(b_sounds, 500, i), now);
            mixer.pull(out, now);
            power = i < 100 ? 0 : power + power_of(out) / 100;
        }
        return power;
    };
    const double both = run(true, true), one = run(true, false), none = run(false, false);
    EXPECT_NEAR(both / one, 2, 0.3);
    EXPECT_LT(none, one / 1000);
    const auto speakers = mixer.speakers();
    ASSERT_EQ(speakers.size(), 2u);
    EXPECT_LT(speakers[0].level_db, -60);
    EXPECT_EQ(mixer.unreadable(), 0u);
}

TEST(Mixer, UnreadablePacketsAreCountedAndManySpeakersAreBounded) {
    Mixer mixer;
    mixer.put(alice, Bytes(20), from_us(0));
    EXPECT_EQ(mixer.unreadable(), 1u);
    Talker talker(20, [&](ByteView bytes) {
        for (std::uint32_t id = 1; id <= 100; ++id)
            mixer.put(ParticipantId{id}, bytes, from_us(id));
    });
    talker.take(block_of(true, 300, 0), from_us(10'000));
    talker.take(block_of(true, 300, 1), from_us(20'000));
    ASSERT_EQ(mixer.speakers().size(), Mixer::max_speakers);
    EXPECT_EQ(mixer.speakers().back().id, ParticipantId{100});
}

}  // namespace
}  // namespace theatron::voice
