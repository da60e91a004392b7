// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "bench_voice.h"
#include "voice/opus_codec.h"
#include "voice/packet.h"
#include "voice/playout.h"

namespace theatron::bench {
namespace {

using std::numbers::pi;

constexpr int seconds = 60;
constexpr double loss = 0.05, jitter_us = 30'000;

// A vowel whose pitch goes up and down, without a pause.
std::vector<float> vowel() {
    std::vector<float> samples(std::size_t(seconds) * voice::sample_rate);
    double phase = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        phase += 2 * pi * (130 + 25 * std::sin(5.6 * double(i) / voice::sample_rate)) /
                 voice::sample_rate;
        double sum = 0;
        for (int k = 1; k <= 16; ++k)
            sum += std::sin(k * phase) / k;
        samples[i] = float(0.2 * sum);
    }
    return samples;
}

}  // namespace

nlohmann::json lost_5_percent(int frame_ms) {
    const std::vector<float> said = vowel();
    voice::Encoder encoder(frame_ms);
    const std::size_t frame = encoder.frame_samples();
    struct Arrival {
        double us = 0;
        std::uint32_t number = 0;
        Bytes opus;
    };
    std::vector<Arrival> arrivals;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> jitter(0, jitter_us), chance(0, 1);
    std::size_t lost = 0;
    for (std::size_t i = 0; (i + 1) * frame <= said.size(); ++i) {
        Bytes opus;
        (void)encoder.encode(std::span(said).subspan(i * frame, frame), opus);
        if (chance(random) < loss)
            lost += frame;
        else
            arrivals.push_back({double((i + 1) * frame) * 1e6 / voice::sample_rate + jitter(random),
                                std::uint32_t(i), std::move(opus)});
    }
    std::sort(arrivals.begin(), arrivals.end(),
              [](const Arrival& a, const Arrival& b) { return a.us < b.us; });

    voice::Decoder decoder;
    voice::Playout playout(decoder);
    std::vector<float> block(480);
    std::int64_t next_us = 0;
    for (const Arrival& arrival : arrivals) {
        for (; double(next_us) < arrival.us; next_us += 10'000)
            playout.pull(block, from_us(next_us));
        voice::Packet packet;
        packet.number = arrival.number;
        packet.frame_ms = frame_ms;
        packet.level_db = -10;
        packet.opus = arrival.opus;
        playout.put(packet, from_us(std::int64_t(arrival.us)));
    }
    const voice::Playout::Figures& f = playout.figures();
    const double played = double(f.samples);
    return {{"longest_gap_ms", double(f.longest_concealed) * 1000 / voice::sample_rate},
            {"concealed_percent", 100 * double(f.concealed) / played},
            {"beyond_lost_percent",
             100 * (double(f.concealed) + double(f.recovered) - double(lost)) / played}};
}

}  // namespace theatron::bench
