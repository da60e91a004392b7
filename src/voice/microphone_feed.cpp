// SPDX-License-Identifier: Apache-2.0
#include "voice/microphone_feed.h"

namespace theatron::voice {
namespace {

// Blocks that wait; those of a usual device have 480 samples.
constexpr std::size_t most_blocks = 512;

}  // namespace

MicrophoneFeed::MicrophoneFeed() : samples_(most_samples), blocks_(most_blocks) {}

void MicrophoneFeed::take(std::span<const float> samples, TimePoint end) noexcept {
    if (samples_.room() < samples.size() || blocks_.room() == 0) {
        lost_ += samples.size();
        return;
    }
    (void)samples_.put(samples);
    const Block block{end, samples.size()};
    (void)blocks_.put({&block, 1});
}

void MicrophoneFeed::drain(const Use& use) {
    for (Block block{}; blocks_.take({&block, 1}) == 1;) {
        block_.resize(block.samples);
        (void)samples_.take(block_);
        use(block_, block.end);
    }
}

}  // namespace theatron::voice
