// SPDX-License-Identifier: Apache-2.0
#include "record/stream_gate.h"

#include <gtest/gtest.h>

namespace theatron::record {
namespace {

constexpr TimePoint begin = from_us(1'000'000'000);
constexpr StreamId depth = depth_stream(CameraId{0}), color = color_stream(CameraId{0});

wire::MediaHeader frame(FrameNumber number, FrameNumber reference, int layer = 0,
                        StreamId stream = depth) {
    wire::MediaHeader header;
    header.stream = stream;
    header.frame = number;
    header.reference = reference;
    header.key = number == reference;
    header.temporal_layer = std::uint8_t(layer);
    return header;
}

TEST(StreamGate, BeginsWithAKeyFrameAndAsksForIt) {
    StreamGate gate;
    const auto follower = gate.on_frame(frame(1, 0), begin);
    EXPECT_FALSE(follower.record);
    EXPECT_TRUE(follower.ask_for_key);
    EXPECT_FALSE(gate.on_frame(frame(2, 1), begin + 10ms).ask_for_key) << "asked for already";
    EXPECT_TRUE(gate.on_frame(frame(3, 2), begin + 10ms + StreamGate::key_patience).ask_for_key);
    EXPECT_TRUE(gate.on_frame(frame(4, 4), begin + 800ms).record);
    EXPECT_TRUE(gate.on_frame(frame(5, 4), begin + 833ms).record);
    EXPECT_EQ(gate.figures().recorded, 2u);
    EXPECT_EQ(gate.figures().lost, 0u) << "what came before belongs to no recording";
}

TEST(StreamGate, TheSessionsClockDoesNotMatter) {
    for (const Duration ahead : {Duration(0), Duration(24h), Duration(-24h)}) {
        StreamGate gate;
        for (FrameNumber n = 0; n < 300; ++n) {
            wire::MediaHeader header = frame(n, n == 0 ? 0 : n - 1);
            header.captured = begin + ahead + n * Duration(33'340);  // 200 ppm fast
            EXPECT_TRUE(gate.on_frame(header, begin + n * Duration(33'333)).record);
        }
        EXPECT_EQ(gate.figures().recorded, 300u);
    }
}

TEST(StreamGate, LeavesOutFramesWhoseReferenceIsNotThere) {
    StreamGate gate;
    EXPECT_TRUE(gate.on_frame(frame(8, 8), begin).record);
    // Frame 12 of layer 0 was lost on the way, so the next of layer 0 cannot be decoded.
    const auto upper = gate.on_frame(frame(14, 12, 1), begin + 1s);
    EXPECT_FALSE(upper.record);
    EXPECT_FALSE(upper.ask_for_key);
    const auto base = gate.on_frame(frame(16, 12), begin + 1s);
    EXPECT_FALSE(base.record);
    EXPECT_TRUE(base.ask_for_key);
    EXPECT_TRUE(gate.on_frame(frame(17, 17), begin + 1s).record);
    EXPECT_EQ(gate.figures().lost, 8u) << "9 to 16";
}

TEST(StreamGate, ADroppedFrameClosesTheChainUntilTheNextKey) {
    StreamGate gate;
    EXPECT_TRUE(gate.on_frame(frame(0, 0), begin).record);
    EXPECT_TRUE(gate.on_frame(frame(1, 0), begin).record);
    EXPECT_TRUE(gate.on_dropped(begin)) << "a key frame is asked for at once";
    const auto follower = gate.on_frame(frame(2, 1), begin);
    EXPECT_FALSE(follower.record);
    EXPECT_FALSE(follower.ask_for_key) << "and not again so soon";
    EXPECT_FALSE(gate.on_frame(frame(3, 0), begin).record) << "the chain is not taken up again";
    EXPECT_TRUE(gate.on_frame(frame(4, 4), begin).record);
    EXPECT_EQ(gate.figures().recorded, 2u);
    EXPECT_EQ(gate.figures().dropped, 1u);
    EXPECT_EQ(gate.figures().lost, 2u);
}

TEST(StreamGate, AsksForAKeyFrameInEachPeriodHoweverManyComeOtherwise) {
    constexpr Duration phase = 500ms, spacing = 100ms;
    StreamGate gate(phase);
    std::vector<Duration> asked;
    for (FrameNumber n = 0; n * spacing < 3 * StreamGate::key_period; ++n) {
        const bool other_key = n == 7;  // somebody joined
        if (gate.on_frame(frame(n, n == 0 || other_key ? n : n - 1), begin + n * spacing)
                .ask_for_key)
            asked.push_back(n * spacing);
    }
    EXPECT_EQ(asked, (std::vector<Duration>{phase, phase + StreamGate::key_period,
                                            phase + 2 * StreamGate::key_period}));
}

TEST(StreamGate, AsksForNoKeyFramesWhereEachIsOne) {
    StreamGate gate;
    for (FrameNumber n = 0; n < 300; ++n)
        EXPECT_FALSE(gate.on_frame(frame(n, n), begin + n * 33ms).ask_for_key);
}

TEST(StreamGate, FramesThatCameWithoutColourAreNotLost) {
    StreamGate gate;
    EXPECT_TRUE(gate.on_frame(frame(0, 0, 0, color), begin).record);
    EXPECT_TRUE(gate.on_frame(frame(2, 0, 0, color), begin).record);
    EXPECT_EQ(gate.figures().lost, 0u);
}

}  // namespace
}  // namespace theatron::record
