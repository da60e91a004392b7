// SPDX-License-Identifier: Apache-2.0
#include "photon/stages.h"

#include <gtest/gtest.h>

namespace theatron::photon {
namespace {

FrameTimes whole_way() {
    FrameTimes t;
    t.captured = from_us(1'000'000);
    t.delivered = from_us(1'010'000);
    t.filtered = from_us(1'012'000);
    t.encoded = from_us(1'020'000);
    t.sent = from_us(1'021'000);
    t.received = from_us(1'041'000);
    t.decoded = from_us(1'045'000);
    t.uploaded = from_us(1'050'000);
    t.presented = from_us(1'060'000);
    return t;
}

double sum_of(const std::vector<Stage>& stages) {
    double sum = 0;
    for (const Stage& stage : stages)
        sum += stage.mean_ms;
    return sum;
}

std::size_t times_found(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

TEST(Stages, EachIsFromThePointBeforeItAndAllAreTheAge) {
    StageSum sum;
    sum.add(whole_way());
    const std::vector<Stage> stages = sum.means();
    ASSERT_EQ(stages.size(), 8u);
    const double expected[] = {10, 2, 8, 1, 20, 4, 5, 10};
    for (std::size_t i = 0; i < stages.size(); ++i)
        EXPECT_DOUBLE_EQ(stages[i].mean_ms, expected[i]) << stages[i].id;
    EXPECT_DOUBLE_EQ(sum_of(stages), 60);
    EXPECT_EQ(stages.front().id, "delivered");
    EXPECT_EQ(stages.back().id, "presented");
}

TEST(Stages, AnUnknownPointsTimeIsInTheNextStage) {
    FrameTimes times = whole_way();
    times.filtered = {};
    StageSum sum;
    sum.add(times);
    const std::vector<Stage> stages = sum.means();
    ASSERT_EQ(stages.size(), 7u);
    EXPECT_EQ(stages[1].id, "encoded");
    EXPECT_DOUBLE_EQ(stages[1].mean_ms, 10);
    EXPECT_DOUBLE_EQ(sum_of(stages), 60);
}

TEST(Stages, MeansOfDifferentPicturesStillAddUpToTheMeanAge) {
    FrameTimes other = whole_way();
    other.filtered = {};
    other.presented = from_us(1'080'000);
    StageSum sum;
    sum.add(whole_way());
    sum.add(other);
    EXPECT_EQ(sum.pictures(), 2);
    EXPECT_DOUBLE_EQ(sum_of(sum.means()), 70);
}

TEST(Stages, PicturesWithoutBothEndsDoNotCount) {
    FrameTimes no_start = whole_way(), no_end = whole_way();
    no_start.captured = {};
    no_end.presented = {};
    StageSum sum;
    sum.add(no_start);
    sum.add(no_end);
    EXPECT_EQ(sum.pictures(), 0);
    EXPECT_TRUE(sum.means().empty());
}

TEST(StagePlot, HasABarAndALineForEachStage) {
    const std::string svg =
        stages_svg({{"sent", "host", 30}, {"received", "network <slow>", 10}}, "a & b");
    EXPECT_EQ(times_found(svg, "class='stage'"), 2u);
    EXPECT_NE(svg.find("x='16.0' y='40.0' width='546.0'"), std::string::npos);
    EXPECT_NE(svg.find("x='562.0' y='40.0' width='182.0'"), std::string::npos);
    EXPECT_NE(svg.find("network &lt;slow&gt;"), std::string::npos);
    EXPECT_NE(svg.find("a &amp; b"), std::string::npos);
    EXPECT_NE(svg.find("40.0 ms in all"), std::string::npos);
}

TEST(StagePlot, OfNoTimeHasFiniteNumbers) {
    const std::string svg = stages_svg({{"sent", "host", 0}, {"received", "network", -1}}, "");
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("width='-"), std::string::npos);
}

}  // namespace
}  // namespace theatron::photon
