// SPDX-License-Identifier: Apache-2.0
// Generated speech, echo and noise.
#include "sound/echo_canceller.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "voice/packet.h"

namespace theatron::sound {
namespace {

constexpr std::size_t block = EchoCanceller::block;

// Syllables of about 0.25 s with pauses: harmonics of a moving pitch through two moving resonances.
std::vector<float> speech(double seconds, unsigned seed, double pitch_hz) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(0, 1);
    std::vector<float> samples(std::size_t(seconds * voice::sample_rate));
    double phase = 0, pitch = pitch_hz, formant = 700, loud = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t syllable = voice::sample_rate / 4;
        if (i % syllable == 0) {
            pitch = pitch_hz * (0.85 + 0.4 * any(random));
            formant = 400 + 1600 * any(random);
            loud = any(random) < 0.25 ? 0 : 0.5 + 0.5 * any(random);
        }
        phase += pitch / voice::sample_rate;
        double value = 0;
        for (int k = 1; k <= 20; ++k) {
            const double away = (k * pitch - formant) / 300;
            value += std::sin(2 * std::numbers::pi * k * phase) / (1 + away * away);
        }
        const double within = double(i % syllable) / double(syllable);
        samples[i] = float(0.12 * loud * std::sin(std::numbers::pi * within) * value +
                           0.002 * (any(random) - 0.5));
    }
    return samples;
}

// A room of 100 ms behind a delay.
std::vector<float> echo_of(const std::vector<float>& played, double delay_ms, double gain) {
    std::mt19937 random(9);
    std::normal_distribution<float> normal;
    const std::size_t delay = std::size_t(delay_ms * voice::sample_rate / 1000);
    std::vector<std::pair<std::size_t, float>> paths{{delay, float(gain)}};
    for (int i = 0; i < 40; ++i) {
        const double ms = 100.0 * i / 40;
        paths.emplace_back(delay + std::size_t(ms * voice::sample_rate / 1000),
                           float(0.3 * gain * std::exp(-ms / 25)) * normal(random));
    }
    std::vector<float> echo(played.size());
    for (const auto& [behind, share] : paths)
        for (std::size_t i = behind; i < played.size(); ++i)
            echo[i] += share * played[i - behind];
    return echo;
}

double power_db(std::span<const float> samples) {
    double sum = 1e-12;
    for (const float v : samples)
        sum += double(v) * double(v);
    return 10 * std::log10(sum / double(samples.size()));
}

// A microphone beside a loudspeaker, behind the canceller.
std::vector<float> cleaned(const std::vector<float>& played, std::vector<float> heard) {
    EchoCanceller canceller;
    for (std::size_t i = 0; i + block <= heard.size(); i += block) {
        canceller.played(std::span(played).subspan(i, block));
        canceller.clean(std::span<float, block>(heard.data() + i, block));
    }
    return heard;
}

TEST(EchoCanceller, TakesTheEchoOutOfTheMicrophone) {
    const std::vector<float> played = speech(12, 1, 120);
    for (const double delay_ms : {30.0, 80.0, 160.0}) {
        const std::vector<float> echo = echo_of(played, delay_ms, 0.5);
        const std::vector<float> left = cleaned(played, echo);
        const std::size_t settled = 6 * voice::sample_rate;
        const double loss =
            power_db(std::span(echo).subspan(settled)) - power_db(std::span(left).subspan(settled));
        std::printf("echo of %.0f ms: %.1f dB weaker\n", delay_ms, loss);
        EXPECT_GT(loss, 20) << delay_ms;
    }
}

// The person beside the echo stays: the gain control may change the loudness, so spectra over time
// are not compared, only that syllables rise where the person speaks.
TEST(EchoCanceller, KeepsThePersonWhoSpeaks) {
    const std::vector<float> person = speech(12, 5, 210);
    const std::vector<float> silence(person.size());
    const std::vector<float> left = cleaned(silence, person);
    const std::size_t settled = 4 * voice::sample_rate, window = voice::sample_rate / 50;
    double own = 0, other = 0, both = 0;
    for (std::size_t i = settled; i + window <= left.size(); i += window) {
        const double a = std::max(power_db(std::span(person).subspan(i, window)), -60.0) + 60;
        const double b = std::max(power_db(std::span(left).subspan(i, window)), -60.0) + 60;
        own += a * a;
        other += b * b;
        both += a * b;
    }
    EXPECT_GT(both / std::sqrt(own * other), 0.9);
    EXPECT_GT(power_db(std::span(left).subspan(settled)),
              power_db(std::span(person).subspan(settled)) - 6);
}

// The gain may rise as a whole, so speech is compared with its pauses.
TEST(EchoCanceller, MakesSteadyNoiseWeaker) {
    std::mt19937 random(2);
    std::normal_distribution<float> normal(0, 0.01f);
    const std::vector<float> person = speech(15, 11, 150);
    std::vector<float> noisy = person;
    for (float& v : noisy)
        v += normal(random);
    const std::vector<float> left = cleaned(std::vector<float>(noisy.size()), noisy);
    const auto above_noise = [&](const std::vector<float>& samples) {
        const std::size_t settled = 7 * voice::sample_rate, window = voice::sample_rate / 50;
        double loud = 0, quiet = 0;
        int loud_windows = 0, quiet_windows = 0;
        for (std::size_t i = settled; i + window <= samples.size(); i += window) {
            const double said = power_db(std::span(person).subspan(i, window));
            const double power = std::pow(10, power_db(std::span(samples).subspan(i, window)) / 10);
            if (said > -25) {
                loud += power;
                ++loud_windows;
            } else if (said < -60) {
                quiet += power;
                ++quiet_windows;
            }
        }
        EXPECT_GT(loud_windows, 20);
        EXPECT_GT(quiet_windows, 20);
        return 10 * std::log10(loud / loud_windows / (quiet / quiet_windows));
    };
    const double before = above_noise(noisy), after = above_noise(left);
    std::printf("speech above noise: %.1f dB, then %.1f dB\n", before, after);
    EXPECT_GT(after, before + 6);
}

TEST(EchoCanceller, MakesAQuietVoiceLouder) {
    std::vector<float> quiet = speech(15, 7, 150);
    for (float& v : quiet)
        v *= 0.1f;
    const std::vector<float> left = cleaned(std::vector<float>(quiet.size()), quiet);
    const std::size_t settled = 8 * voice::sample_rate;
    EXPECT_GT(power_db(std::span(left).subspan(settled)),
              power_db(std::span(quiet).subspan(settled)) + 3);
}

TEST(EchoCanceller, TakesBlocksOfAnySizeOfTheLoudspeaker) {
    EchoCanceller canceller;
    const std::vector<float> played = speech(1, 3, 120);
    for (std::size_t i = 0, size = 1; i + size < played.size();
         i += size, size = size * 7 % 1000 + 1)
        canceller.played(std::span(played).subspan(i, size));
    std::array<float, block> heard{};
    canceller.clean(heard);
    EXPECT_LT(power_db(heard), -60);
}

}  // namespace
}  // namespace theatron::sound
