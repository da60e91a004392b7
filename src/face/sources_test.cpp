// SPDX-License-Identifier: Apache-2.0
#include "face/sources.h"

#include <gtest/gtest.h>

#include <cmath>

#include "face/face_input.h"

namespace theatron::face {
namespace {

std::vector<float> one_input(Source source, std::string_view name, float value) {
    const SourceTable& table = table_of(source);
    std::vector<float> inputs(table.inputs.size());
    const auto input = table.input_of(name);
    EXPECT_TRUE(input) << name;
    inputs[input.value_or(0)] = value;
    return inputs;
}

TEST(FaceSources, HaveTheSizesOfOpenXr) {
    EXPECT_EQ(table_of(Source::arkit).inputs.size(), 52U);
    EXPECT_EQ(table_of(Source::xr_fb_face2).inputs.size(), 70U);
    EXPECT_EQ(table_of(Source::xr_htc).inputs.size(), 14U + 37U);
    // Positions that openxr.h numbers.
    EXPECT_EQ(table_of(Source::xr_fb_face2).input_of("XR_FACE_EXPRESSION2_JAW_DROP_FB"), 24U);
    EXPECT_EQ(table_of(Source::xr_htc).input_of("XR_LIP_EXPRESSION_JAW_OPEN_HTC"), 14U + 3U);
}

TEST(FaceSources, EachTermFeedsAChannelFromAKnownInput) {
    for (const Source source : all_sources) {
        const SourceTable& table = table_of(source);
        for (const Term& term : table.terms) {
            EXPECT_LT(term.input, table.inputs.size());
            EXPECT_LT(term.channel, channel_count);
        }
        EXPECT_EQ(source_of(source_name(source)), source);
    }
    EXPECT_FALSE(source_of("quest"));
}

TEST(FaceSources, HtcHasNoBrowsAndFbHasAll) {
    const ChannelMask htc = table_of(Source::xr_htc).mask;
    for (const Channel brow : {brow_down_left, brow_inner_up, brow_outer_up_right, nose_sneer_left})
        EXPECT_FALSE(htc[brow]);
    EXPECT_TRUE(htc[mouth_smile_left] && htc[eye_squint_right]);
    EXPECT_EQ(htc.count(), 36U);
    EXPECT_TRUE(table_of(Source::xr_fb_face2).mask.all());
    EXPECT_TRUE(table_of(Source::unified).mask.all());
}

TEST(FaceSources, GazeOfTheLeftEyeToTheRightLooksIn) {
    const Mapped mapped =
        map_inputs(Source::xr_fb_face2, one_input(Source::xr_fb_face2, "EYES_LOOK_RIGHT_L", 0.5F));
    EXPECT_FLOAT_EQ(mapped.values[eye_look_in_left], 0.5F);
    EXPECT_FLOAT_EQ(mapped.values[eye_look_out_left], 0);
    EXPECT_FLOAT_EQ(mapped.values[eye_look_out_right], 0);
}

TEST(FaceSources, ASignedValueFeedsOneOfTwoChannels) {
    const SourceTable& table = table_of(Source::unified);
    std::vector<bool> present(table.inputs.size());
    present[*table.input_of("SmileFrownLeft")] = true;
    const Mapped frown =
        map_inputs(Source::unified, one_input(Source::unified, "SmileFrownLeft", -0.6F), present);
    EXPECT_FLOAT_EQ(frown.values[mouth_frown_left], 0.6F);
    EXPECT_FLOAT_EQ(frown.values[mouth_smile_left], 0);
    EXPECT_EQ(frown.present.count(), 2U);
}

TEST(FaceSources, AChannelIsTheMeanOfWhatIsPresent) {
    const SourceTable& table = table_of(Source::xr_fb_face2);
    std::vector<float> inputs = one_input(Source::xr_fb_face2, "LIP_PUCKER_L", 0.8F);
    EXPECT_FLOAT_EQ(map_inputs(Source::xr_fb_face2, inputs).values[mouth_pucker], 0.4F);
    std::vector<bool> present(inputs.size(), true);
    present[*table.input_of("LIP_PUCKER_R")] = false;
    EXPECT_FLOAT_EQ(map_inputs(Source::xr_fb_face2, inputs, present).values[mouth_pucker], 0.8F);
}

TEST(FaceSources, ValuesThatAreNoNumbersAreAbsentAndOthersLimited) {
    std::vector<float> inputs(channel_count);
    inputs[jaw_open] = NAN;
    inputs[cheek_puff] = 7;
    inputs[tongue_out] = -7;
    const Mapped mapped = map_inputs(Source::arkit, inputs);
    EXPECT_FALSE(mapped.present[jaw_open]);
    EXPECT_FLOAT_EQ(mapped.values[cheek_puff], 1);
    EXPECT_FLOAT_EQ(mapped.values[tongue_out], 0);
}

TEST(FaceSources, ShortAndLongInputsAreSafe) {
    EXPECT_EQ(map_inputs(Source::xr_htc, std::vector<float>()).present.count(), 0U);
    EXPECT_EQ(map_inputs(Source::xr_fb_face2, std::vector<float>(63)).present.count(), 51U);
    EXPECT_EQ(map_inputs(Source::xr_htc, std::vector<float>(1000)).present,
              table_of(Source::xr_htc).mask);
}

TEST(FaceInput, RelaxesToNeutralWithinASecondAndSaysSo) {
    FaceInput input;
    EXPECT_EQ(input.at(from_us(0)).tracking, Tracking::waiting);
    std::vector<float> values(channel_count);
    values[brow_down_left] = 1;
    const TimePoint start = from_us(5'000'000);
    input.put(map_inputs(Source::arkit, values), start);
    EXPECT_FLOAT_EQ(input.at(start + 249ms).values[brow_down_left], 1);
    EXPECT_EQ(input.at(start + 249ms).tracking, Tracking::tracked);
    float last = 1;
    for (Duration age = 260ms; age < 1s; age += 10ms) {
        const FaceNow now = input.at(start + age);
        EXPECT_EQ(now.tracking, Tracking::relaxing);
        EXPECT_LT(now.values[brow_down_left], last);
        last = now.values[brow_down_left];
    }
    EXPECT_LT(last, 0.01F);
    EXPECT_EQ(input.at(start + 1s).tracking, Tracking::lost);
    EXPECT_EQ(input.at(start + 1s).values, Channels{});
    input.put(map_inputs(Source::arkit, values), start + 2s);
    EXPECT_EQ(input.at(start + 2s).tracking, Tracking::tracked);
}

}  // namespace
}  // namespace theatron::face
