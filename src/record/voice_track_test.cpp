// SPDX-License-Identifier: Apache-2.0
#include "record/voice_track.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace theatron::record {
namespace {

constexpr TimePoint speech_begin = from_us(7'000'000'123);
const Bytes opus(40, std::byte{0x78});

struct Written {
    Duration at{};
    bool is_silence = false;
    Duration length{};
};

// By its first byte (RFC 6716, 3.1).
Duration length_of(const VoiceSequence::Block& block) {
    if (!block.is_silence)
        return 20ms;
    switch (std::to_integer<int>(block.opus[0])) {
        case 0xf0:
            return 10ms;
        case 0xf8:
            return 20ms;
        default:
            return 120ms;
    }
}

class Sequence : public ::testing::Test {
protected:
    VoiceSequence::Write write() {
        return [this](const VoiceSequence::Block& block) {
            blocks_.push_back({block.at, block.is_silence, length_of(block)});
        };
    }
    void say(std::uint32_t number, Duration at, bool pauses = false, int frame_ms = 20) {
        sequence_.put({number, speech_begin + at, frame_ms, pauses, -20, opus}, write());
    }
    std::vector<Duration> speech() const {
        std::vector<Duration> places;
        for (const Written& block : blocks_)
            if (!block.is_silence)
                places.push_back(block.at);
        return places;
    }
    // Each block begins where the one before ends.
    void expect_gapless() const {
        Duration end{};
        for (const Written& block : blocks_) {
            EXPECT_EQ(block.at, end);
            end += block.length;
        }
    }

    VoiceSequence sequence_{speech_begin};
    std::vector<Written> blocks_;
};

TEST_F(Sequence, BeginsWithSilenceAndHasNoGaps) {
    say(0, 400ms);
    say(1, 420ms, true);
    say(60, 1600ms);
    EXPECT_EQ(speech(), (std::vector<Duration>{400ms, 420ms, 1600ms}));
    expect_gapless();
    EXPECT_EQ(sequence_.figures().packets, 3u);
    EXPECT_EQ(sequence_.figures().missing, 0u);
}

TEST_F(Sequence, ALostPacketIsSilenceOfItsLength) {
    say(0, 0ms);
    say(3, 60ms);
    EXPECT_EQ(speech(), (std::vector<Duration>{0ms, 60ms}));
    expect_gapless();
    EXPECT_EQ(sequence_.figures().missing, 2u);
}

TEST_F(Sequence, APacketThatWasWithheldIsSilenceButNotMissing) {
    say(0, 0ms);
    sequence_.interrupt();
    say(30, 600ms);
    say(32, 640ms);
    EXPECT_EQ(speech(), (std::vector<Duration>{0ms, 600ms, 640ms}));
    expect_gapless();
    EXPECT_EQ(sequence_.figures().missing, 1u) << "the one on the way";
}

TEST_F(Sequence, JitterOfTheSpeakersClockMovesNothing) {
    std::minstd_rand random(3);
    for (std::uint32_t i = 0; i < 500; ++i)
        say(i, 20ms * i + Duration(random() % 25'000));
    ASSERT_EQ(speech().size(), 500u);
    EXPECT_EQ(speech().back() - speech().front(), 499 * 20ms);
    expect_gapless();
}

// A sound card that is 200 ppm slow or fast, for an hour without a pause.
TEST_F(Sequence, StaysAtTheSpeakersTimeWhenItsClockDrifts) {
    for (const double rate : {1 - 200e-6, 1 + 200e-6}) {
        sequence_ = VoiceSequence(speech_begin);
        std::size_t blocks = 0;
        for (std::uint32_t i = 0; i < 180'000; ++i) {
            const Duration at(std::int64_t(20'000.0 * i * rate));
            sequence_.put({i, speech_begin + at, 20, false, -20, opus},
                          [&](const VoiceSequence::Block& block) {
                              blocks += !block.is_silence;
                              const auto error = block.is_silence ? 0 : (block.at - at).count();
                              ASSERT_LE(std::abs(error), 30'000) << i;
                          });
        }
        EXPECT_GE(blocks, 180'000u - 40) << "one packet in 100 s is left out at most";
    }
}

TEST_F(Sequence, WhatComesAfterItsPlaceWasFilledIsLeftOut) {
    say(0, 0ms, true);
    sequence_.fill(speech_begin + 1s, write());
    say(10, 200ms);
    EXPECT_EQ(sequence_.figures().left_out, 1u);
    say(60, 1200ms);
    EXPECT_EQ(speech(), (std::vector<Duration>{0ms, 1200ms}));
    expect_gapless();
}

TEST_F(Sequence, NumbersThatBeginAnewAreSpeechToo) {
    say(1'000'000, 0ms);
    say(0, 20ms);
    say(1, 40ms);
    EXPECT_EQ(speech(), (std::vector<Duration>{0ms, 20ms, 40ms}));
    // One that overtook another is left out.
    say(3, 80ms);
    say(2, 60ms);
    EXPECT_EQ(sequence_.figures().left_out, 1u);
}

TEST_F(Sequence, TimesOfAnyValueCostLittle) {
    for (const std::int64_t us : {std::int64_t(-1) << 60, std::int64_t(1) << 60})
        sequence_.put({5, from_us(us), 20, false, 0, opus}, write());
    EXPECT_EQ(blocks_.size(), 0u);
    sequence_.fill(from_us(std::int64_t(1) << 60), write());
    EXPECT_LE(blocks_.size(), 5000u);
}

}  // namespace
}  // namespace theatron::record
