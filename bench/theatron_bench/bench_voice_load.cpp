// SPDX-License-Identifier: Apache-2.0
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <thread>

#include "base/statistics.h"
#include "base/steady_clock.h"
#include "bench_voice.h"
#include "sound/feed_thread.h"
#include "sound/sound_device.h"
#include "sound/voice_output.h"
#include "voice/talker.h"

namespace theatron::bench {
namespace {

constexpr int speakers = 4, frame_ms = 20;
constexpr auto period = 10ms;

// The packets of one speaker: a tone.
std::vector<Bytes> packets_of(int speaker, double seconds) {
    std::vector<Bytes> packets;
    voice::Talker talker(frame_ms, [&packets](ByteView packet) {
        packets.emplace_back(packet.begin(), packet.end());
    });
    std::vector<float> samples(std::size_t(seconds * voice::sample_rate));
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = float(0.2 * std::sin(2 * std::numbers::pi * (200 + 90 * speaker) * double(i) /
                                          voice::sample_rate));
    talker.take(samples, TimePoint{});
    return packets;
}

// A thread of lower priority for each processor, as long as this object lives.
class BusyMachine {
public:
    BusyMachine() {
        for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
            threads_.emplace_back([](const std::stop_token& ends) {
                constexpr int lower = 5;
                setpriority(PRIO_PROCESS, id_t(gettid()), lower);
                volatile double value = 1;
                while (!ends.stop_requested())
                    value = std::sqrt(value + 1);
            });
    }

private:
    std::vector<std::jthread> threads_;
};

// Calls `work` at even times, as a device does.
template <class Work>
void at_pace(std::chrono::microseconds step, double seconds, const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < int(seconds * 1e6 / double(step.count())); ++i) {
        std::this_thread::sleep_until(begin + i * step);
        work(std::size_t(i));
    }
}

}  // namespace

nlohmann::json callback_under_load(double seconds) {
    constexpr double settling_seconds = 1;
    const double all = seconds + settling_seconds;
    std::vector<std::vector<Bytes>> packets;
    std::map<ParticipantId, Vec3> heads;
    for (int i = 0; i < speakers; ++i) {
        packets.push_back(packets_of(i, all + 1));
        heads[ParticipantId(i + 1)] = {double(i) - 1.5, 1.7, -1};
    }
    sound::VoiceOutput output;
    output.begin(2);
    output.place(Pose{{}, {0, 1.7, 0}}, heads);
    sound::FeedThread thread("loudspeaker", [&output] { return output.work(steady_now); });
    std::vector<double> durations_us;
    std::uint64_t missing_before = 0;
    {
        const BusyMachine load;
        std::jthread network([&] {
            at_pace(std::chrono::milliseconds(frame_ms), all, [&](std::size_t number) {
                for (int i = 0; i < speakers; ++i)
                    if (number < packets[std::size_t(i)].size())
                        output.hear(ParticipantId(i + 1), packets[std::size_t(i)][number],
                                    steady_now());
            });
        });
        // SDL gives the threads of its devices this priority, where it may.
        constexpr int highest = -20;
        const int before_device = getpriority(PRIO_PROCESS, id_t(gettid()));
        setpriority(PRIO_PROCESS, id_t(gettid()), highest);
        std::vector<float> out(2 * sound::block_samples);
        at_pace(period, all, [&](std::size_t number) {
            const auto before = std::chrono::steady_clock::now();
            output.play(out, steady_now());
            thread.wake();
            const std::chrono::duration<double, std::micro> taken =
                std::chrono::steady_clock::now() - before;
            if (double(number) * 0.01 >= settling_seconds)
                durations_us.push_back(taken.count());
            else
                missing_before = output.figures().missing;
        });
        setpriority(PRIO_PROCESS, id_t(gettid()), before_device);
    }
    const auto figures = output.figures();
    return {{"p50_us", percentile(durations_us, 0.5)},
            {"p99_us", percentile(durations_us, 0.99)},
            {"max_us", percentile(durations_us, 1)},
            {"count", durations_us.size()},
            {"period_us", std::chrono::microseconds(period).count()},
            {"missing_ms", double(figures.missing - missing_before) * 1000 / voice::sample_rate},
            {"lead_ms", to_ms(figures.lead)}};
}

}  // namespace theatron::bench
