// SPDX-License-Identifier: Apache-2.0
// Between a microphone and the thread that uses its sound: the microphone's callback only copies
// its samples; take() waits for nothing, takes no lock and allocates nothing. A block that finds no
// room is lost, and counted.
//
// Pure; time is passed in. take() belongs to the device's thread, drain() to another one.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/spsc_ring.h"
#include "base/time.h"

namespace theatron::voice {

class MicrophoneFeed {
public:
    // Samples that wait to be used at most: half a second.
    static constexpr std::size_t most_samples = 24'000;

    MicrophoneFeed();

    // The device has delivered samples of one channel; `end` is the time behind the last one.
    void take(std::span<const float> samples, TimePoint end) noexcept;

    // Gives `use` each block that was delivered since the last call, in order; it is valid during
    // that call.
    using Use = std::function<void(std::span<const float> samples, TimePoint end)>;
    void drain(const Use& use);

    // Samples that found no room. Any thread.
    std::uint64_t lost() const { return lost_; }

private:
    struct Block {
        TimePoint end;
        std::size_t samples;
    };
    SpscRing<float> samples_;
    SpscRing<Block> blocks_;
    std::atomic<std::uint64_t> lost_ = 0;
    std::vector<float> block_;
};

}  // namespace theatron::voice
