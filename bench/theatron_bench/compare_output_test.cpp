// SPDX-License-Identifier: Apache-2.0
#include "compare_output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "compare_page.h"

namespace theatron::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Given figures; nothing here has been measured.
Compared given_comparison() {
    const CompareLink slow{20, 20};
    Compared c;
    c.processor = "Some <Processor>";
    c.cores = 2;
    c.gl_renderer = "llvmpipe";
    c.cameras = 2;
    c.frames = 30;
    c.depth = {640, 576};
    c.color = {1280, 720};
    c.picture = {16, 8};
    c.links = {slow};
    c.places = {"at the foot of the table", "a step to the left"};
    c.truth = {ColorImage({16, 8}), ColorImage({16, 8})};
    CompareMethod call{.id = video_call_id, .name = "Video call", .ran = "one camera"};
    call.cameras = 1;
    call.mbit_per_camera = 2.04;
    call.sender_ms = 9.34;
    call.receiver_ms = 2.15;
    call.links = {{slow, 30, 34.8, 37.1}};
    call.own_view = CompareOwnView{31.1, 0.961};
    call.expert_reason = "It has no other picture.";
    call.pictures = {ColorImage({16, 8})};
    CompareMethod pcl{.id = pcl_id, .name = "A point cloud codec", .ran = "PCL"};
    pcl.reason = "This build has no PCL.";
    CompareMethod ours{.id = theatron_id, .name = "Theatron", .ran = "strata"};
    ours.cameras = 2;
    ours.mbit_per_camera = 15.48;
    ours.sender_ms = 6.2;
    ours.receiver_ms = 3;
    ours.links = {{slow, 19, 99.2, 128.2}};
    ours.expert = CompareLikeness{20.91, 0.7725, 3.26, 17.43};
    ours.from_place = {{21.5, 0.78, 2.5, 17}, {20.4, 0.76, 4.5, 18}};
    ours.pictures = {ColorImage({16, 8}), ColorImage({16, 8})};
    c.methods = {call, pcl, ours};
    return c;
}

int times_in(const std::string& text, const std::string& part) {
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

TEST(CompareText, EachMethodHasItsFiguresOrItsReason) {
    const std::string text = compare_text(given_comparison());
    EXPECT_THAT(text, HasSubstr("\nVideo call                         1      2.0      9.3"
                                "       2.1        30.0         35  none\n"));
    EXPECT_THAT(text,
                HasSubstr("\nA point cloud codec         not measured: This build has no PCL.\n"));
    EXPECT_THAT(text, HasSubstr("\nTheatron                           2     15.5      6.2"
                                "       3.0        19.0         99        20.9   0.772      3.3"
                                "     17.4\n"));
    EXPECT_THAT(text, HasSubstr("It has no other picture."));
    for (const std::string& sentence : compare_limits())
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
    EXPECT_EQ(methods[1]["mbit_per_camera"], nullptr);
    EXPECT_EQ(methods[1]["links"], nullptr);
    EXPECT_EQ(methods[1]["reason"], "This build has no PCL.");
    EXPECT_EQ(methods[2]["expert"]["holes_percent"], 3.26);
    EXPECT_EQ(methods[2]["own_view"], nullptr);
    EXPECT_EQ(json["picture"]["width"], 16);
    EXPECT_EQ(json["here"]["gl_renderer"], "llvmpipe");
}

TEST(ComparePage, ShowsEachPlaceWithTheTruthBesideEachMethod) {
    const std::string page = compare_page(given_comparison());
    // Each place has three: truth, video call, Theatron.
    EXPECT_EQ(times_in(page, "<img "), 6);
    EXPECT_EQ(times_in(page, "data:image/jpeg;base64,"), 6);
    EXPECT_EQ(times_in(page, "This build has no PCL."), 2);
    EXPECT_EQ(times_in(page, "This is the camera&#39;s place, not the expert&#39;s."), 1);
    EXPECT_EQ(times_in(page, "The same picture as before"), 1);
    EXPECT_THAT(
        page,
        HasSubstr(
            "2.5 % of what the cameras see is missing; likeness 21.5 dB (higher is better)."));
    EXPECT_THAT(
        page,
        HasSubstr(
            "4.5 % of what the cameras see is missing; likeness 20.4 dB (higher is better)."));
}

TEST(ComparePage, SaysWhatItCostsAndWhatItDoesNotSay) {
    const std::string page = compare_page(given_comparison());
    EXPECT_THAT(page, HasSubstr("That costs 15.5 Mbit/s for each of 2 cameras, 15 times the video "
                                "call in all"));
    EXPECT_THAT(page, HasSubstr("Theatron has 19 pictures a second, each 99 ms old on arrival; the "
                                "video call 30 pictures a second, each 35 ms old on arrival."));
    EXPECT_THAT(page, HasSubstr("Some &lt;Processor&gt;"));
    EXPECT_THAT(page, Not(HasSubstr("src=\"http")));
    EXPECT_THAT(page, HasSubstr("That takes a study with surgeons."));
}

TEST(ComparePage, IsMadeWithoutAVideoCall) {
    Compared c = given_comparison();
    c.methods[0] = {.id = video_call_id, .name = "Video call", .ran = "", .reason = "No library."};
    const std::string page = compare_page(c);
    EXPECT_THAT(page, HasSubstr("No library."));
    EXPECT_THAT(page, Not(HasSubstr("times the video call")));
    EXPECT_THAT(page, Not(HasSubstr("A video call needs the least")));
}

}  // namespace
}  // namespace theatron::bench
