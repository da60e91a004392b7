// SPDX-License-Identifier: Apache-2.0
// Between a loudspeaker and the thread that makes its sound: the loudspeaker's callback only copies
// samples that are ready. play() waits for nothing, takes no lock and allocates nothing.
//
// fill() renders a block just before the device asks for it: `lead` before, which covers how late
// the rendering thread was lately. Samples that are not ready are silent, and counted.
//
// Pure; time is passed in. play() belongs to the device's thread, fill() and the rest to another
// one.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/spsc_ring.h"
#include "base/time.h"
#include "voice/device_pace.h"

namespace theatron::voice {

class SpeakerFeed {
public:
    // Time from the rendering of a block until the device asks for it.
    static constexpr Duration least_lead = std::chrono::milliseconds(2),
                              most_lead = std::chrono::milliseconds(40);
    // Beside the longest delay of the rendering thread in the last blocks.
    static constexpr Duration lead_margin = std::chrono::milliseconds(1);
    static constexpr std::size_t remembered_delays = 1000;  // at least half as many count
    // Blocks that are ready at most: some devices ask for several at once.
    static constexpr std::size_t most_blocks = 6;
    // Samples of each channel for which the device asks at once; of more, the rest is silent.
    static constexpr std::size_t largest_block = 4096;

    // `channels`: 1, or 2 for a left and a right sample in turns.
    explicit SpeakerFeed(int channels);

    // The device takes its next samples, all channels in turns, at `now`.
    void play(std::span<float> out, TimePoint now) noexcept;

    using Now = std::function<TimePoint()>;
    // Fills `out`, all channels in turns. The time is that of the first sample for a jitter buffer:
    // when it is asked for, but earlier where the lead is longer than the shortest.
    using Render = std::function<void(std::span<float> out, TimePoint heard)>;
    // Renders what must be ready. Call it after each play(), and at the time that it returns, which
    // is the largest one if there is nothing to do before the next play().
    TimePoint fill(const Now& now, const Render& render);

    Duration lead() const { return lead_; }
    // Samples of each channel that were not ready, from the first rendered one on. Any thread.
    std::uint64_t missing() const { return missing_; }

private:
    // A call of the device, as its thread tells it.
    struct Asked {
        TimePoint at;
        std::size_t samples;  // of each channel
        std::uint64_t taken;  // of the ring, since the beginning
    };
    void note_delay(Duration delay);

    const std::size_t channels_;
    SpscRing<float> ready_;
    SpscRing<Asked> asked_;

    // The device's thread's.
    std::uint64_t played_ = 0;

    std::atomic<bool> has_rendered_ = false;
    std::atomic<std::uint64_t> missing_ = 0;

    // The rendering thread's.
    DevicePace pace_;
    std::uint64_t rendered_ = 0, taken_ = 0;
    std::vector<float> block_;
    TimePoint planned_ = TimePoint::max();
    Duration lead_ = least_lead;
    Duration newest_delay_{}, older_delay_{};  // the longest of two halves of the last blocks
    std::size_t delays_ = 0;                   // in the newer half
};

}  // namespace theatron::voice
