// SPDX-License-Identifier: Apache-2.0
#include "sound/spatial_voices.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "sound/sound_device.h"
#include "voice/packet.h"

namespace theatron::sound {
namespace {

constexpr ParticipantId ada{1}, ben{2};
constexpr int second = voice::sample_rate;

struct Ears {
    std::vector<float> left, right;
};

std::vector<float> noise(int samples, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<float> result(static_cast<std::size_t>(samples));
    for (float& v : result)
        v = 0.1f * (float(random() % 20'001) / 10'000 - 1);
    return result;
}

// One who speaks noise for two seconds at this place.
Ears heard(SpatialWay way, Vec3 from_head) {
    SpatialVoices voices(way);
    EXPECT_EQ(voices.way(), way);
    const std::vector<float> said = noise(2 * second, 1);
    Ears ears;
    std::array<float, 2 * block_samples> out{};
    for (std::size_t i = 0; i + block_samples <= said.size(); i += block_samples) {
        const SpatialVoices::Voice voice{ada, from_head, std::span(said).subspan(i, block_samples)};
        voices.mix(std::span(&voice, 1), out);
        for (std::size_t k = 0; k < block_samples; ++k) {
            ears.left.push_back(out[2 * k]);
            ears.right.push_back(out[2 * k + 1]);
        }
    }
    return ears;
}

double power(const std::vector<float>& samples) {
    double sum = 0;
    for (const float v : samples)
        sum += double(v) * v;
    return sum / double(samples.size());
}

double level_difference_db(const Ears& ears) {
    return 10 * std::log10(power(ears.left) / power(ears.right));
}

// The delay of the right ear after the left one at which both are most alike.
int delay_samples(const Ears& ears) {
    int best = 0;
    double best_sum = 0;
    for (int lag = -60; lag <= 60; ++lag) {
        double sum = 0;
        for (int i = 2000; i < second; ++i)
            sum += double(ears.right[std::size_t(i)]) * ears.left[std::size_t(i - lag)];
        if (std::abs(sum) > best_sum) {
            best_sum = std::abs(sum);
            best = lag;
        }
    }
    return best;
}

// The power of a frequency, in dB.
double level_at(const std::vector<float>& samples, double hz) {
    double real = 0, imaginary = 0, sum = 0;
    // Many windows are averaged, since noise differs from one to the next.
    constexpr std::size_t window = 480;
    for (std::size_t begin = 0; begin + window <= samples.size(); begin += window) {
        real = imaginary = 0;
        for (std::size_t i = 0; i < window; ++i) {
            const double angle = 2 * std::numbers::pi * hz * double(i) / voice::sample_rate;
            real += samples[begin + i] * std::cos(angle);
            imaginary += samples[begin + i] * std::sin(angle);
        }
        sum += real * real + imaginary * imaginary;
    }
    return 10 * std::log10(sum);
}

constexpr Vec3 at_left{-1.5, 0, 0}, at_right{1.5, 0, 0}, ahead{0, 0, -1.5}, behind{0, 0, 1.5};

TEST(SpatialVoices, AVoiceAtTheLeftIsEarlierAndLouderInTheLeftEar) {
    const Ears left = heard(SpatialWay::hrtf, at_left), pan = heard(SpatialWay::panning, at_left);
    EXPECT_GT(delay_samples(left), 24) << "half a millisecond";
    EXPECT_LT(delay_samples(left), 48);
    EXPECT_EQ(delay_samples(pan), 0);
    EXPECT_NEAR(level_difference_db(pan), 6, 0.1);
    EXPECT_GT(level_difference_db(left), level_difference_db(pan) + 4);
    const Ears right = heard(SpatialWay::hrtf, at_right);
    EXPECT_LT(delay_samples(right), -24);
    EXPECT_LT(level_difference_db(right), -10);
}

TEST(SpatialVoices, AheadAndBehindDifferInSpectrumAndNotBetweenTheEars) {
    const Ears front = heard(SpatialWay::hrtf, ahead), back = heard(SpatialWay::hrtf, behind);
    for (const Ears& ears : {front, back}) {
        EXPECT_EQ(delay_samples(ears), 0);
        EXPECT_NEAR(level_difference_db(ears), 0, 1.5);
    }
    double least = 1e9, most = -1e9;
    for (const double hz : {500, 1000, 2000, 4000, 6000, 8000, 10'000, 12'000}) {
        const double difference = level_at(front.left, hz) - level_at(back.left, hz);
        least = std::min(least, difference);
        most = std::max(most, difference);
    }
    EXPECT_GT(most - least, 6) << "dB between frequencies";
    const Ears front_pan = heard(SpatialWay::panning, ahead),
               back_pan = heard(SpatialWay::panning, behind);
    EXPECT_EQ(front_pan.left, back_pan.left);
}

TEST(SpatialVoices, AVoiceAheadIsAboutAsLoudAsItWasSpokenAndWeakerFarAway) {
    const double said = power(noise(2 * second, 1));
    for (const SpatialWay way : {SpatialWay::hrtf, SpatialWay::panning}) {
        const double near = power(heard(way, ahead).left);
        EXPECT_NEAR(10 * std::log10(near / said), 0, 3);
        const double far = power(heard(way, {0, 0, -4.5}).left);
        EXPECT_NEAR(10 * std::log10(near / far), 6, 1) << "half as loud at 4.5 m";
    }
    EXPECT_EQ(loudness_at(0), 1);
    EXPECT_EQ(loudness_at(4.5), 0.5);
}

// Without a gap or a click between blocks of any size, also where others come and go.
TEST(SpatialVoices, AVoiceGoesOnSmoothlyWhileOthersComeAndGo) {
    SpatialVoices voices;
    ASSERT_EQ(voices.way(), SpatialWay::hrtf);
    std::vector<float> tone(second);
    for (std::size_t i = 0; i < tone.size(); ++i)
        tone[i] = 0.2f * float(std::sin(2 * std::numbers::pi * 200 * double(i) / second));
    const std::vector<float> silence(1000);
    std::vector<float> left;
    for (std::size_t i = 0, n = 0; i + 1000 <= tone.size(); ++n) {
        const std::size_t size = 160 + 80 * (n % 7);
        std::vector<SpatialVoices::Voice> all{{ada, ahead, std::span(tone).subspan(i, size)}};
        if (n % 3 == 0)
            all.push_back({ben, at_left, std::span(silence).first(size)});
        std::vector<float> out(2 * size);
        voices.mix(all, out);
        for (std::size_t k = 0; k < size; ++k)
            left.push_back(out[2 * k]);
        i += size;
    }
    const double amplitude = std::sqrt(2 * power({left.begin() + 4800, left.end()}));
    const double steepest = amplitude * 2 * std::numbers::pi * 200 / second;
    for (std::size_t i = 4800; i < left.size(); ++i)
        ASSERT_LT(std::abs(left[i] - left[i - 1]), 1.2 * steepest) << i;
}

TEST(SpatialVoices, WithoutVoicesThereIsSilence) {
    SpatialVoices voices;
    std::vector<float> out(960, 1.0f);
    voices.mix({}, out);
    EXPECT_EQ(out, std::vector<float>(960));
}

}  // namespace
}  // namespace theatron::sound
