// SPDX-License-Identifier: Apache-2.0
#include "sound/voice_output.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "voice/talker.h"

namespace theatron::sound {
namespace {

constexpr ParticipantId left_one{1}, right_one{2};
constexpr std::size_t device_block = 480;
constexpr Duration device_period = 10ms;

// A speaker whose tone comes in packets of 20 ms.
class Tone {
public:
    explicit Tone(double hz) : hz_(hz) {}
    // The packets of the next 10 ms, up to this time.
    std::vector<Bytes> next(TimePoint end) {
        std::vector<float> samples(device_block);
        for (float& v : samples)
            v = float(0.2 *
                      std::sin(2 * std::numbers::pi * hz_ * double(said_++) / voice::sample_rate));
        packets_.clear();
        talker_.take(samples, end);
        return packets_;
    }

private:
    const double hz_;
    std::size_t said_ = 0;
    std::vector<Bytes> packets_;
    voice::Talker talker_{
        20, [this](ByteView packet) { packets_.emplace_back(packet.begin(), packet.end()); }};
};

// A loudspeaker in given time, and the rendering thread, which is punctual.
class Loudspeaker {
public:
    Loudspeaker(VoiceOutput& output, int channels) : output_(output), channels_(channels) {
        output_.begin(channels);
    }
    std::vector<float> next(TimePoint at) {
        for (; planned_ <= at; planned_ = output_.work([this] { return planned_; }))
            ;
        std::vector<float> out(device_block * std::size_t(channels_));
        output_.play(out, at);
        planned_ = output_.work([at] { return at; });
        return out;
    }

private:
    VoiceOutput& output_;
    const int channels_;
    TimePoint planned_ = TimePoint::max();
};

double power_of(const std::vector<float>& samples, std::size_t first = 0, std::size_t step = 1) {
    double sum = 0;
    for (std::size_t i = first; i < samples.size(); i += step)
        sum += double(samples[i]) * samples[i];
    return sum;
}

TEST(VoiceOutput, TheLoudspeakerPlaysWhatIsRenderedAndInWhateverOrderSpeakersCome) {
    const auto run = [](bool first_is_first) {
        std::vector<float> rendered, played;
        VoiceOutput output([&](std::span<const float> samples) {
            rendered.insert(rendered.end(), samples.begin(), samples.end());
        });
        Loudspeaker loudspeaker(output, 1);
        Tone one(300), other(500);
        for (TimePoint now = from_us(0); now < from_us(1'000'000); now += device_period) {
            const auto hear = [&](ParticipantId id, Tone& tone) {
                for (const Bytes& packet : tone.next(now))
                    output.hear(id, packet, now);
            };
            if (first_is_first)
                hear(left_one, one);
            hear(right_one, other);
            if (!first_is_first)
                hear(left_one, one);
            const auto out = loudspeaker.next(now);
            played.insert(played.end(), out.begin(), out.end());
        }
        // Before the first call of the device nothing could be rendered.
        played.erase(played.begin(), played.begin() + device_block);
        EXPECT_EQ(played, rendered);
        EXPECT_EQ(output.figures().speakers.size(), 2u);
        EXPECT_EQ(output.figures().missing, 0u);
        return played;
    };
    const auto played = run(true);
    EXPECT_GT(power_of(played), 100);
    EXPECT_EQ(played, run(false));
}

TEST(VoiceOutput, AVoiceIsHeardFromWhereTheSpeakerStands) {
    VoiceOutput output;
    Loudspeaker loudspeaker(output, 2);
    Tone tone(2000);
    TimePoint now;
    const auto run = [&] {
        std::vector<float> played;
        for (int i = 0; i < 50; ++i, now += device_period) {
            for (const Bytes& packet : tone.next(now))
                output.hear(left_one, packet, now);
            const auto out = loudspeaker.next(now);
            if (i >= 20)
                played.insert(played.end(), out.begin(), out.end());
        }
        return power_of(played, 0, 2) / power_of(played, 1, 2);
    };
    EXPECT_NEAR(run(), 1, 1e-6) << "before places are known";
    const Pose head{{1, 0, 0, 0}, {5, 1.7, 0}};
    output.place(head, {{left_one, {4, 1.7, 0}}});
    EXPECT_GT(run(), 2) << "at the left";
    output.place(head, {{left_one, {6, 1.7, 0}}});
    EXPECT_LT(run(), 0.5) << "at the right";
    output.place(head, {});
    EXPECT_NEAR(run(), 1, 0.2) << "ahead, where the place is not known";
    EXPECT_TRUE(output.figures().space);
}

TEST(VoiceOutput, AnotherDeviceBeginsWithSilenceAndGoesOn) {
    VoiceOutput output;
    Tone tone(300);
    TimePoint now;
    for (const int channels : {1, 2, 1}) {
        Loudspeaker loudspeaker(output, channels);
        EXPECT_EQ(power_of(loudspeaker.next(now)), 0);
        double power = 0;
        for (int i = 0; i < 50; ++i) {
            now += device_period;
            for (const Bytes& packet : tone.next(now))
                output.hear(left_one, packet, now);
            power += power_of(loudspeaker.next(now));
        }
        EXPECT_GT(power, 100);
        EXPECT_EQ(output.figures().missing, 0u);
    }
}

TEST(VoiceOutput, SpeakersAreKnownWithoutADeviceAndNothingIsKept) {
    VoiceOutput output;
    EXPECT_EQ(output.work([] { return TimePoint{}; }), TimePoint::max());
    Tone tone(300);
    TimePoint now;
    for (int i = 0; i < 50; ++i) {
        now += device_period;
        for (const Bytes& packet : tone.next(now))
            output.hear(left_one, packet, now);
    }
    EXPECT_EQ(output.speaking(now), std::set<ParticipantId>{left_one});
    EXPECT_NEAR(output.levels_db(now).at(left_one), -17, 1);
    EXPECT_TRUE(output.figures().speakers.empty());
    EXPECT_FALSE(output.figures().space);
}

}  // namespace
}  // namespace theatron::sound
