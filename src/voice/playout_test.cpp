// SPDX-License-Identifier: Apache-2.0
// Speakers, links and sound cards in made-up time.
#include "voice/playout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "voice/opus_codec.h"

namespace theatron::voice {
namespace {

using std::numbers::pi;

constexpr std::size_t tone_period = 240;  // samples: 200 Hz

float tone(std::uint64_t sample) {
    static const std::vector<float> table = [] {
        std::vector<float> values(tone_period);
        for (std::size_t i = 0; i < tone_period; ++i)
            values[i] = float(0.5 * std::sin(2 * pi * double(i) / double(tone_period)));
        return values;
    }();
    return table[sample % tone_period];
}

// A voice that never pauses: 24 harmonics of a pitch that goes up and down.
std::vector<float> endless_vowel(std::size_t samples) {
    std::vector<float> result(samples);
    double phase = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        const double t = double(i) / sample_rate;
        phase += 2 * pi * (130 + 25 * std::sin(2 * pi * 0.9 * t)) / sample_rate;
        double sum = 0;
        for (int k = 1; k <= 24; ++k)
            sum += std::sin(k * phase) / k;
        result[i] = float(0.2 * sum);
    }
    return result;
}

// Each frame is the tone; a frame that is concealed is silence.
class ToneDecoder : public FrameDecoder {
public:
    bool decode(ByteView, std::span<float> out) override {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = tone(i);
        return true;
    }
    bool recover(ByteView, std::span<float>) override { return false; }
    void conceal(std::span<float> out) override { std::fill(out.begin(), out.end(), 0.0f); }
};

const Bytes any_bytes(1);

Packet tone_packet(std::uint32_t number, int frame_ms = 20) {
    Packet packet;
    packet.number = number;
    packet.frame_ms = frame_ms;
    packet.level_db = -10;
    packet.opus = any_bytes;
    return packet;
}

// Blocks of 10 ms are pulled until `end`; `ppm`: how much faster the listener's sound card is.
struct SoundCard {
    double ppm = 0;
    double next_us = 0;
    std::vector<float> block = std::vector<float>(480);
    template <class F>
    void play(Playout& playout, TimePoint end, F&& heard) {
        for (; next_us < double(to_us(end)); next_us += 10'000 / (1 + ppm * 1e-6)) {
            playout.pull(block, from_us(std::int64_t(next_us)));
            heard(block);
        }
    }
};

TEST(Playout, APunctualVoiceComesOutUnchanged) {
    ToneDecoder decoder;
    Playout playout(decoder);
    SoundCard card;
    std::vector<float> heard;
    const auto keep = [&](const auto& block) {
        heard.insert(heard.end(), block.begin(), block.end());
    };
    for (std::uint32_t i = 0; i < 30; ++i) {
        const TimePoint at = from_us(i * 20'000 + 5'000);
        card.play(playout, at, keep);
        playout.put(tone_packet(i), at);
    }
    const auto first = std::find_if(heard.begin(), heard.end(), [](float v) { return v != 0; });
    ASSERT_NE(first, heard.end());
    for (std::size_t i = 0; i < 9'600; ++i)
        ASSERT_EQ(*(first - 1 + std::ptrdiff_t(i)), tone(i)) << i;
    EXPECT_EQ(playout.figures().concealed, 0u);
}

TEST(Playout, APunctualVoiceWaitsForFewMilliseconds) {
    ToneDecoder decoder;
    Playout playout(decoder);
    SoundCard card;
    for (std::uint32_t i = 0; i < 500; ++i) {
        const TimePoint at = from_us(i * 10'000);
        card.play(playout, at, [](const auto&) {});
        playout.put(tone_packet(i, 10), at);
    }
    EXPECT_LE(to_ms(playout.delay()), 18)
        << "after the first seconds, with a target of " << to_ms(playout.target());
    EXPECT_EQ(playout.figures().concealed, 0u);
}

// 60 s with 5 % loss and 0 to 30 ms of additional delay, in which packets overtake one another.
TEST(Playout, LossAndJitterConcealLittleMoreThanWasLost) {
    for (const int frame_ms : {10, 20}) {
        const std::size_t frame = std::size_t(frame_ms) * 48;
        const std::vector<float> voice = endless_vowel(60 * sample_rate);
        Encoder encoder(frame_ms);
        Decoder decoder;
        Playout playout(decoder);
        std::mt19937 random(7);
        std::uniform_real_distribution<double> jitter(0, 30'000), chance(0, 1);
        struct Arrival {
            std::int64_t us;
            Packet packet;
            Bytes bytes;
        };
        std::vector<Arrival> arrivals;
        std::size_t lost = 0;
        for (std::size_t i = 0; (i + 1) * frame <= voice.size(); ++i) {
            Bytes bytes;
            encoder.encode(std::span(voice).subspan(i * frame, frame), bytes);
            if (chance(random) < 0.05) {
                lost += frame;
                continue;
            }
            const double at = double((i + 1) * frame) / 0.048 + jitter(random);
            arrivals.push_back({std::int64_t(at), tone_packet(std::uint32_t(i), frame_ms), bytes});
        }
        std::sort(arrivals.begin(), arrivals.end(),
                  [](const Arrival& a, const Arrival& b) { return a.us < b.us; });
        SoundCard card;
        std::vector<float> heard;
        const auto keep = [&](const auto& block) {
            heard.insert(heard.end(), block.begin(), block.end());
        };
        for (Arrival& arrival : arrivals) {
            card.play(playout, from_us(arrival.us), keep);
            arrival.packet.opus = arrival.bytes;
            playout.put(arrival.packet, from_us(arrival.us));
        }
        const Playout::Figures& figures = playout.figures();
        const double beyond = double(figures.concealed + figures.recovered) - double(lost);
        EXPECT_LE(beyond, 0.01 * double(figures.samples)) << frame_ms << " ms";
        EXPECT_LE(figures.longest_concealed, 40u * 48) << frame_ms << " ms";
        EXPECT_GT(figures.recovered, frame_ms == 10 ? lost / 2 : lost / 5) << frame_ms << " ms";
        EXPECT_LE(to_ms(playout.delay()), 50) << frame_ms << " ms";
        // The vowel is never silent.
        std::size_t longest = 0, run = 0;
        for (std::size_t i = 24'000; i < heard.size(); ++i) {
            run = std::abs(heard[i]) < 1e-3f ? run + 1 : 0;
            longest = std::max(longest, run);
        }
        EXPECT_LE(longest, 40u * 48) << frame_ms << " ms";
        RecordProperty("beyond_percent_" + std::to_string(frame_ms),
                       std::to_string(100 * beyond / double(figures.samples)));
        RecordProperty("delay_ms_" + std::to_string(frame_ms),
                       std::to_string(to_ms(playout.delay())));
        RecordProperty("longest_ms_" + std::to_string(frame_ms),
                       std::to_string(double(figures.longest_concealed) / 48));
    }
}

TEST(Playout, AnHourWithSoundCards200PpmApartNeitherGrowsNorBreaks) {
    for (const double ppm : {-200.0, 200.0}) {
        ToneDecoder decoder;
        Playout playout(decoder);
        SoundCard card{ppm};
        float last = 0, largest_step = 0;
        const auto listen = [&](const auto& block) {
            for (const float v : block) {
                largest_step = std::max(largest_step, std::abs(v - last));
                last = v;
            }
        };
        Duration shortest = 1h, longest{};
        constexpr std::uint32_t frames = 3600 * 50;
        for (std::uint32_t i = 0; i < frames; ++i) {
            const TimePoint at = from_us(std::int64_t(i) * 20'000);
            card.play(playout, at, listen);
            playout.put(tone_packet(i), at);
            if (i > 500) {
                shortest = std::min(shortest, playout.delay());
                longest = std::max(longest, playout.delay());
            }
        }
        EXPECT_LT(to_ms(longest - shortest), 15) << ppm;
        EXPECT_EQ(playout.figures().concealed, 0u) << ppm;
        // 0.72 s in the hour, in periods of 5 to 10 ms; not many more than that.
        EXPECT_GT(playout.figures().stretches, 50u) << ppm;
        EXPECT_LT(playout.figures().stretches, 300u) << ppm;
        EXPECT_LT(largest_step, 0.05f) << "no click at " << ppm;
    }
}

TEST(Playout, ALinkThatStoodStillIsCaughtUpWith) {
    ToneDecoder decoder;
    Playout playout(decoder);
    SoundCard card;
    const auto ignore = [](const auto&) {};
    for (std::uint32_t i = 0; i < 1000; ++i) {
        // From frame 200 on nothing comes for 200 ms; then all of it at once.
        const std::uint32_t arrives = i >= 200 && i < 210 ? 210 : i;
        const TimePoint at = from_us(std::int64_t(arrives) * 20'000);
        card.play(playout, at, ignore);
        playout.put(tone_packet(i), at);
    }
    card.play(playout, from_us(1000 * 20'000), ignore);
    EXPECT_LE(to_ms(playout.delay()), 60);
    EXPECT_LE(playout.figures().concealed, 220u * 48);
}

TEST(Playout, APauseIsSilenceAndConcealsNothing) {
    ToneDecoder decoder;
    Playout playout(decoder);
    SoundCard card;
    std::size_t silent = 0;
    const auto count = [&](const auto& block) {
        silent += std::size_t(std::count(block.begin(), block.end(), 0.0f));
    };
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const TimePoint at = from_us(std::int64_t(i) * 20'000);
        card.play(playout, at, count);
        Packet packet = tone_packet(i);
        packet.pauses = i == 100 || i == 1100;
        const bool is_sent = i <= 100 || (i >= 150 && i <= 1100) || i >= 1900;
        if (is_sent)
            playout.put(packet, at);
        if (i == 500)
            EXPECT_EQ(playout.level_db(), -10);
        if (i == 1500)
            EXPECT_EQ(playout.level_db(), -127);
    }
    EXPECT_EQ(playout.figures().concealed, 0u);
    EXPECT_GT(silent, (49u + 799u) * 960 - 9'600);
}

TEST(Playout, ASpeakerWithoutAPacketIsSilent) {
    ToneDecoder decoder;
    Playout playout(decoder);
    std::vector<float> out(480, 1.0f);
    playout.pull(out, from_us(0));
    EXPECT_EQ(out, std::vector<float>(480, 0.0f));
}

TEST(Playout, AFloodOfPacketsKeepsABoundedNumber) {
    ToneDecoder decoder;
    Playout playout(decoder);
    for (std::uint32_t i = 0; i < 100'000; ++i)
        playout.put(tone_packet(i), from_us(0));
    std::vector<float> out(480);
    for (int i = 0; i < 1000; ++i)
        playout.pull(out, from_us(i * 10'000));
    EXPECT_LE(playout.figures().samples, (Playout::max_waiting_packets + 6) * 960);
}

}  // namespace
}  // namespace theatron::voice
