// SPDX-License-Identifier: Apache-2.0
#include "record/stream_gate.h"

#include <gtest/gtest.h>

namespace theatron::record {
namespace {

constexpr TimePoint begin = from_us(1'000'000'000);

wire::MediaHeader frame(FrameNumber number, FrameNumber reference, Duration captured_after,
                        int layer = 0) {
    wire::MediaHeader header;
    header.frame = number;
    header.reference = reference;
    header.key = number == reference;
    header.temporal_layer = std::uint8_t(layer);
    header.captured = begin + captured_after;
    return header;
}

TEST(StreamGate, BeginsWithAFreshKeyFrameAndAsksForIt) {
    StreamGate gate(begin);
    const auto old_key = gate.on_frame(frame(1, 1, -60s), begin);
    EXPECT_FALSE(old_key.record);
    EXPECT_TRUE(old_key.ask_for_key);
    const auto follower = gate.on_frame(frame(2, 1, 0s), begin + 10ms);
    EXPECT_FALSE(follower.record);
    EXPECT_FALSE(follower.ask_for_key) << "it was asked for already";
    EXPECT_TRUE(gate.on_frame(frame(3, 3, 33ms), begin + 40ms).record);
    EXPECT_TRUE(gate.on_frame(frame(4, 3, 66ms), begin + 70ms).record);
}

TEST(StreamGate, TakesAnOldKeyFrameOfACameraThatStandsStill) {
    StreamGate gate(begin);
    EXPECT_FALSE(gate.on_frame(frame(1, 1, -60s), begin + 1s).record);
    EXPECT_TRUE(gate.on_frame(frame(2, 2, -60s), begin + 2s).record);
}

TEST(StreamGate, LeavesOutFramesWhoseReferenceIsNotThere) {
    StreamGate gate(begin);
    EXPECT_TRUE(gate.on_frame(frame(8, 8, 0s), begin).record);
    // Frame 12 of layer 0 was lost on the way, so the next of layer 0 cannot be decoded.
    const auto upper = gate.on_frame(frame(14, 12, 1s, 1), begin + 1s);
    EXPECT_FALSE(upper.record);
    EXPECT_FALSE(upper.ask_for_key);
    const auto base = gate.on_frame(frame(16, 12, 2s), begin + 2s);
    EXPECT_FALSE(base.record);
    EXPECT_TRUE(base.ask_for_key);
    EXPECT_TRUE(gate.on_frame(frame(17, 17, 3s), begin + 3s).record);
}

}  // namespace
}  // namespace theatron::record
