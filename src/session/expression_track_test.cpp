// SPDX-License-Identifier: Apache-2.0
#include "session/expression_track.h"

#include <gtest/gtest.h>

namespace theatron::session {
namespace {

constexpr std::size_t happiness = 2, neutral = 5;

wire::FaceExpression happy(TimePoint time) {
    wire::FaceExpression face;
    face.time = time;
    face.state = wire::FaceExpression::State::tracked;
    face.emotions[happiness] = 1;
    face.jaw_open = 0.5F;
    return face;
}

const TimePoint begin = from_us(10'000'000);

TEST(ExpressionTrack, MovesFromRestToWhatArrived) {
    ExpressionTrack track;
    EXPECT_FALSE(track.at(begin));
    track.add(happy(begin), begin);
    EXPECT_FLOAT_EQ(track.at(begin)->emotions[neutral], 1);
    EXPECT_FLOAT_EQ(track.at(begin + ExpressionTrack::way / 2)->emotions[happiness], 0.5F);
    EXPECT_TRUE(track.is_moving(begin + ExpressionTrack::way / 2));
    EXPECT_FLOAT_EQ(track.at(begin + ExpressionTrack::way)->emotions[happiness], 1);
    EXPECT_FALSE(track.is_moving(begin + ExpressionTrack::way));
}

TEST(ExpressionTrack, AnOlderOneChangesNothing) {
    ExpressionTrack track;
    track.add(happy(begin), begin);
    wire::FaceExpression old = happy(begin - 1ms);
    old.jaw_open = 1;
    track.add(old, begin + 10ms);
    EXPECT_FLOAT_EQ(track.at(begin + 200ms)->jaw_open, 0.5F);
}

TEST(ExpressionTrack, WithoutNewOnesItRelaxesWithinASecondAndThenIsGone) {
    ExpressionTrack track;
    track.add(happy(begin), begin);
    const TimePoint silent = begin + ExpressionTrack::silent_after;
    EXPECT_FLOAT_EQ(track.at(silent)->emotions[happiness], 1);
    EXPECT_TRUE(track.is_moving(silent));
    const auto relaxed = track.at(begin + 1s);
    ASSERT_TRUE(relaxed);
    EXPECT_FLOAT_EQ(relaxed->emotions[happiness], 0);
    EXPECT_FLOAT_EQ(relaxed->emotions[neutral], 1);
    EXPECT_FLOAT_EQ(relaxed->jaw_open, 0);
    EXPECT_FALSE(track.is_moving(begin + 1s));
    EXPECT_FALSE(track.at(begin + ExpressionTrack::gone_after));
}

TEST(ExpressionTrack, AllChannelsMoveEvenly) {
    ExpressionTrack track;
    wire::FaceExpression face = happy(begin);
    face.channels.emplace().fill(0);
    track.add(face, begin);
    face.time = begin + 100ms;
    face.channels->fill(1);
    track.add(face, begin + 100ms);
    EXPECT_FLOAT_EQ((*track.at(begin + 100ms + ExpressionTrack::way / 2)->channels)[17], 0.5F);
}

}  // namespace
}  // namespace theatron::session
