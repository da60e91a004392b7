// SPDX-License-Identifier: Apache-2.0
#include "compare_output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "given_comparison.h"

namespace theatron::bench {
namespace {

using ::testing::HasSubstr;

TEST(CompareText, EachMethodHasItsFiguresOrItsReason) {
    const std::string text = compare_text(given_comparison());
    EXPECT_THAT(text,
                HasSubstr("\nVideo call                             1      2.0      2.0      9.3"
                          "       2.1        30.0         35  none\n"));
    EXPECT_THAT(
        text,
        HasSubstr("\nA point cloud codec             not measured: This build has no PCL.\n"));
    EXPECT_THAT(text,
                HasSubstr("\nTheatron                               2     31.0     15.5      6.2"
                          "       3.0        19.0         99        20.9   0.772      3.3"
                          "    17.4      15.2        4.3\n"));
    EXPECT_THAT(text, HasSubstr("It has no other picture."));
    EXPECT_THAT(text, HasSubstr("\nWhat may be judged from it:\n  Of what an expert"));
    EXPECT_THAT(text, HasSubstr("\nTheatron                              62.0       2.0        36.0"
                                "     0.0         3.4      12.4       6.1     250.5\n"));
    for (const auto& sentences : {compare_limits(), compare_notes()})
        for (const std::string& sentence : sentences)
            EXPECT_THAT(text, HasSubstr(sentence));
}

TEST(CompareJson, WhatIsNotThereIsNull) {
    const nlohmann::json json = compare_json(given_comparison());
    const nlohmann::json& methods = json["methods"];
    ASSERT_EQ(methods.size(), 3u);
    EXPECT_EQ(methods[0]["id"], "video_call");
    EXPECT_EQ(methods[0]["expert"], nullptr);
    EXPECT_EQ(methods[0]["reason"], nullptr);
    EXPECT_EQ(methods[0]["expert_reason"], "It has no other picture.");
    EXPECT_EQ(methods[0]["links"][0]["delay_ms"]["mean"], 34.8);
    EXPECT_EQ(methods[0]["close_up"], nullptr);
    EXPECT_EQ(methods[1]["mbit_per_camera"], nullptr);
    EXPECT_EQ(methods[1]["mbit_of_all"], nullptr);
    EXPECT_EQ(methods[1]["links"], nullptr);
    EXPECT_EQ(methods[1]["reason"], "This build has no PCL.");
    EXPECT_EQ(methods[2]["expert"]["holes_percent"], 3.26);
    EXPECT_EQ(methods[2]["expert"]["undrawn_unseen_percent"], 15.23);
    EXPECT_EQ(methods[2]["expert"]["see_through_percent"], 4.31);
    EXPECT_EQ(methods[2]["close_up"]["holes_percent"], 6.7);
    EXPECT_EQ(methods[2]["close_up"]["see_through_causes"]["no_camera_percent"], 1.5);
    EXPECT_EQ(methods[2]["close_up"]["instruments_missing"]["drawing_percent"], 2);
    EXPECT_DOUBLE_EQ(methods[2]["mbit_of_all"], 2 * 15.48);
    EXPECT_EQ(methods[2]["own_view"], nullptr);
    EXPECT_EQ(methods[2]["wound"]["near"]["rightly_percent"], 62);
    EXPECT_EQ(methods[2]["wound"]["whole"]["wrongly_percent"], 20);
    EXPECT_EQ(methods[2]["wound"]["lost"]["sensor_percent"], 4);
    EXPECT_EQ(methods[0]["wound"]["lost"], nullptr);
    EXPECT_EQ(methods[1]["wound"], nullptr);
    EXPECT_EQ(methods[2]["sender_of_all_ms"], 12.4);
    EXPECT_EQ(methods[2]["drawing_ms"], 250.5);
    EXPECT_EQ(methods[2]["drawn_on"], "llvmpipe");
    EXPECT_EQ(methods[1]["drawing_ms"], nullptr);
    EXPECT_EQ(json["near_wound_m"], 0.2);
    EXPECT_EQ(json["picture"]["width"], 16);
    EXPECT_EQ(json["here"]["gl_renderer"], "llvmpipe");
}

}  // namespace
}  // namespace theatron::bench
