// SPDX-License-Identifier: Apache-2.0
#include "sound/voice_input.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "voice/packet.h"

namespace theatron::sound {
namespace {

// The session's clock is ahead of this machine's.
constexpr Duration offset = 3s;

// A microphone that hears a tone, and the packets that are sent.
struct Speaking {
    VoiceInput input{20,
                     [this](ByteView bytes) {
                         const auto packet = voice::parse_packet(bytes);
                         numbers.push_back(packet->number);
                         times.push_back(packet->time);
                     },
                     [](TimePoint steady) { return steady + offset; }};
    std::vector<std::uint32_t> numbers;
    std::vector<TimePoint> times;
    std::size_t said = 0;

    // Blocks of this many samples, `between` after each.
    template <class Between>
    void say(int blocks, std::size_t size, Between between) {
        for (int i = 0; i < blocks; ++i) {
            std::vector<float> samples(size);
            for (float& v : samples)
                v = float(0.3 * std::sin(2 * std::numbers::pi * 300 * double(said++) /
                                         voice::sample_rate));
            input.take(samples, from_us(std::int64_t(said * 1'000'000 / voice::sample_rate)));
            between();
        }
    }
};

TEST(VoiceInput, BlocksOfAnySizeBecomePacketsWithTheSessionsTime) {
    for (const std::size_t size : {std::size_t(480), std::size_t(441), std::size_t(2048)}) {
        Speaking person;
        person.say(100, size, [&] { person.input.work(); });
        ASSERT_EQ(person.numbers.size(), 100 * size / 960);
        for (std::uint32_t i = 0; i < person.numbers.size(); ++i) {
            EXPECT_EQ(person.numbers[i], i);
            EXPECT_NEAR(double(to_us(person.times[i])), 20'000.0 * i + double(offset / 1us), 2);
        }
        EXPECT_NEAR(person.input.level_db(), -13, 1);
        EXPECT_EQ(person.input.lost(), 0u);
    }
}

TEST(VoiceInput, AClosedMicrophoneSendsOneFrameOfSilence) {
    Speaking person;
    person.say(10, 480, [&] { person.input.work(); });
    person.input.set_open(false);
    EXPECT_FALSE(person.input.is_open());
    const std::size_t before = person.numbers.size();
    person.say(100, 480, [&] { person.input.work(); });
    EXPECT_EQ(person.numbers.size(), before + 1);
}

TEST(VoiceInput, TheCancellerGetsWholeBlocksAndNothingIsLeftOut) {
    EchoCanceller canceller;
    Speaking person;
    person.input.clean_by(&canceller);
    person.say(200, 441, [&] { person.input.work(); });
    // The library may take the tone's level down, so that a part of it counts as silence.
    ASSERT_FALSE(person.numbers.empty());
    for (std::size_t i = 0; i < person.numbers.size(); ++i)
        EXPECT_NEAR(double(to_us(person.times[i])),
                    20'000.0 * person.numbers[i] + double(offset / 1us), 3);
}

TEST(VoiceInput, WhatWasNotUsedInTimeIsCounted) {
    Speaking person;
    person.say(60, 480, [] {});
    EXPECT_EQ(person.input.lost(), 60 * 480 - voice::MicrophoneFeed::most_samples);
    person.input.work();
    EXPECT_EQ(person.numbers.size(), voice::MicrophoneFeed::most_samples / 960);
    person.say(2, 480, [&] { person.input.work(); });
    EXPECT_EQ(person.numbers.back() + 1, person.numbers.size()) << "the count goes on";
}

}  // namespace
}  // namespace theatron::sound
