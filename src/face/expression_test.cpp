// SPDX-License-Identifier: Apache-2.0
#include "face/expression.h"

#include <gtest/gtest.h>

#include <limits>

namespace theatron::face {
namespace {

Emotions only(Emotion emotion, float weight = 1) {
    Emotions weights{};
    weights[std::size_t(emotion)] = weight;
    return weights;
}

TEST(Expression, NeutralMovesNothing) {
    EXPECT_EQ(blend_expressions(only(Emotion::neutral), {}), Channels{});
    EXPECT_EQ(blend_expressions({}, {}), Channels{});
}

TEST(Expression, EachEmotionMovesWhatItShould) {
    const struct {
        Emotion emotion;
        Channel moved, still;
    } cases[] = {{Emotion::sadness, mouth_frown_left, mouth_smile_left},
                 {Emotion::disgust, nose_sneer_right, brow_outer_up_left},
                 {Emotion::happiness, mouth_smile_right, brow_down_left},
                 {Emotion::surprise, brow_outer_up_left, nose_sneer_left},
                 {Emotion::anger, brow_down_right, mouth_smile_left}};
    for (const auto& one : cases) {
        const Channels face = blend_expressions(only(one.emotion), {});
        EXPECT_GT(face[one.moved], 0.8F) << to_text(one.emotion);
        EXPECT_EQ(face[one.still], 0) << to_text(one.emotion);
        EXPECT_EQ(face[jaw_open], 0) << to_text(one.emotion);
    }
}

TEST(Expression, MixesByWeight) {
    const float whole = channels_of(Emotion::happiness)[mouth_smile_left];
    Emotions weights = only(Emotion::happiness, 0.25F);
    weights[std::size_t(Emotion::neutral)] = 0.75F;
    EXPECT_FLOAT_EQ(blend_expressions(weights, {})[mouth_smile_left], whole / 4);
}

TEST(Expression, JawAndLidsFollowThePerson) {
    const Channels face = blend_expressions(only(Emotion::surprise), {0.5F, 1, 0.25F});
    EXPECT_FLOAT_EQ(face[jaw_open], 0.5F);
    EXPECT_FLOAT_EQ(face[eye_blink_left], 1);
    EXPECT_FLOAT_EQ(face[eye_wide_left], 0) << "a closed lid is not wide";
    EXPECT_FLOAT_EQ(face[eye_wide_right], 0.75F * channels_of(Emotion::surprise)[eye_wide_right]);
}

TEST(Expression, HostileValuesAreLimited) {
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                infinite = std::numeric_limits<float>::infinity();
    const Channels face =
        blend_expressions({infinite, -5, 1e30F, nan, 1, 1}, {infinite, nan, -infinite});
    for (const float value : face) {
        EXPECT_GE(value, 0);
        EXPECT_LE(value, 1);
    }
    EXPECT_EQ(face[jaw_open], 1);
    EXPECT_EQ(face[eye_blink_left], 0);
}

}  // namespace
}  // namespace theatron::face
