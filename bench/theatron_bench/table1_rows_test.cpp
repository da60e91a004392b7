// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "table1.h"
#include "table1_inputs.h"

namespace theatron::bench {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Table1Row row(const Table1Measured& measured, const std::string& id) {
    for (const Table1Row& one : table1_rows(measured))
        if (one.id == id)
            return one;
    ADD_FAILURE() << "There is no row " << id << ".";
    return {};
}

TEST(Table1Lines, HaveTheFiguresOfThePaper) {
    std::map<std::string, std::pair<double, double>> paper;
    std::set<std::string> without;
    for (const Table1Line& line : table1_lines()) {
        if (line.paper_low > 0)
            paper[line.id] = {line.paper_low, line.paper_high};
        else
            without.insert(line.id);
        EXPECT_FALSE(line.same.key.empty() && line.best.key.empty()) << line.id;
    }
    const auto one = [](double value) { return std::pair{value, value}; };
    const std::map<std::string, std::pair<double, double>> expected = {
        {"filter.chain", one(1.34)},
        {"filter.holes", one(0.59)},
        {"color.jpeg.full.encode", one(1.5)},
        {"color.jpeg.full.decode", one(1.5)},
        {"color.jpeg.full.size", one(21.9)},
        {"color.jpeg.cropped.encode", one(1.08)},
        {"color.jpeg.cropped.decode", one(1.22)},
        {"color.jpeg.cropped.size", one(18)},
        {"color.h264.full.encode", one(7.72)},
        {"color.h264.full.decode", one(4.84)},
        {"color.h264.full.size", one(15.85)},
        {"depth.trvl.full.encode", one(1.76)},
        {"depth.trvl.full.decode", one(1.19)},
        {"depth.trvl.full.size", one(96.6)},
        {"depth.trvl.cropped.encode", one(1.31)},
        {"depth.trvl.cropped.decode", one(0.987)},
        {"depth.trvl.cropped.size", one(81.78)},
        {"depth.rvl.full.size", one(208)},
        {"depth.h264.full.encode", one(11.04)},
        {"depth.h264.full.decode", one(9.4)},
        {"depth.h264.full.size", one(59.69)},
        {"rate.full", one(3555)},
        {"rate.cropped", one(2993)},
        {"vr.1.splat.low", one(10.9)},
        {"vr.1.mesh.low", one(8.5)},
        {"vr.2.splat.low", one(15)},
        {"vr.2.mesh.low", one(13)},
        {"vr.1.mesh.high", one(12.5)},
        {"vr.2.mesh.high", one(15.5)},
        {"delay.interval", one(33)},
        {"delay.interaction", {22, 29}},
        {"delay.photon", {120, 150}},
    };
    EXPECT_EQ(paper, expected);
    EXPECT_THAT(without, testing::UnorderedElementsAre(
                             "color.h264.cropped.encode", "color.h264.cropped.decode",
                             "color.h264.cropped.size", "depth.rvl.full.encode",
                             "depth.rvl.full.decode", "depth.h264.cropped.encode",
                             "depth.h264.cropped.decode", "depth.h264.cropped.size",
                             "depth.h264.full.error", "delay.answer", "delay.inside"));
}

TEST(Table1Rows, ACellHasTheMedianOfItsRunsAndTheirRange) {
    Table1Measured measured;
    measured.samples["depth/full/trvl/kb"] = {102, 96, 99};
    const Table1Cell cell = row(measured, "depth.trvl.full.size").same;
    ASSERT_TRUE(cell.spread);
    EXPECT_EQ(cell.spread->median, 99);
    EXPECT_EQ(cell.spread->low, 96);
    EXPECT_EQ(cell.spread->high, 102);
    EXPECT_EQ(cell.spread->runs, 3);
    EXPECT_THAT(cell.reason, IsEmpty());
}

TEST(Table1Rows, EveryCellWithoutAFigureHasAReason) {
    for (const Table1Row& one : table1_rows({})) {
        EXPECT_FALSE(one.same.spread) << one.id;
        EXPECT_FALSE(one.same.ran.empty() && one.best.ran.empty()) << one.id;
        if (!one.same.ran.empty()) {
            EXPECT_THAT(one.same.reason, Not(IsEmpty())) << one.id;
        }
        if (!one.best.ran.empty()) {
            EXPECT_THAT(one.best.reason, Not(IsEmpty())) << one.id;
        }
    }
}

TEST(Table1Rows, TheReasonIsThatOfTheNarrowestPart) {
    Table1Measured measured;
    measured.reasons["color"] = "No colour.";
    measured.reasons["color/full/h264:crf=20,encoder=x264/"] = "No x264.";
    EXPECT_EQ(row(measured, "color.h264.full.size").same.reason, "No x264.");
    EXPECT_EQ(row(measured, "color.h264.full.size").best.reason, "No colour.");
    EXPECT_EQ(row(measured, "vr.1.mesh.low").same.reason, "It was not measured.");
}

TEST(Table1Rows, ADeviceIsNamedWhereTheFigureDependsOnIt) {
    Table1Measured measured;
    measured.processor = "Some Processor";
    measured.cores = 2;
    measured.gpu = "Some GPU";
    EXPECT_EQ(row(measured, "depth.trvl.full.encode").device, "Some Processor, one thread");
    EXPECT_EQ(row(measured, "depth.trvl.full.size").device, "any");
    EXPECT_EQ(row(measured, "vr.2.mesh.high").device, "Some GPU");
    EXPECT_EQ(row(measured, "delay.interaction").device, "Some Processor, 2 cores");
}

TEST(Table1Rows, ASoftwareRendererIsNoGpu) {
    Table1Measured measured;
    measured.gpu = "llvmpipe (LLVM 15.0.6, 256 bits)";
    EXPECT_THAT(row(measured, "vr.1.mesh.low").not_comparable,
                Contains(HasSubstr("says nothing about a headset")));
    measured.gpu = "NVIDIA H100/PCIe/SSE2";
    EXPECT_THAT(row(measured, "vr.1.mesh.low").not_comparable,
                Not(Contains(HasSubstr("says nothing about a headset"))));
}

TEST(Table1Rows, AnotherSizeOfPictureIsSaid) {
    Table1Measured measured;
    measured.sizes[Table1Input::depth_full] = paper_full;
    EXPECT_THAT(row(measured, "depth.trvl.full.size").not_comparable,
                Not(Contains(HasSubstr("Other pictures"))));
    measured.sizes[Table1Input::depth_cropped] = {268, 198};
    EXPECT_THAT(row(measured, "depth.trvl.cropped.size").not_comparable,
                Contains("Other pictures: 268x198 here, 540x476 in the paper."));
}

TEST(Table1Rows, LossOfThePapersDepthIsSaidBesideOurs) {
    for (const char* id : {"depth.trvl.full.size", "depth.trvl.cropped.encode", "rate.full"})
        EXPECT_THAT(row({}, id).not_comparable, Contains(HasSubstr("dead band"))) << id;
}

TEST(Table1Inputs, TheCropIsThePapersShareOfThePicture) {
    EXPECT_EQ(paper_crop(paper_full), (capture::Crop{50, 50, paper_cropped}));
    EXPECT_EQ(paper_crop({320, 240}), (capture::Crop{25, 21, {270, 198}}));
    EXPECT_EQ(paper_crop({2, 2}), (capture::Crop{0, 0, {2, 2}}));
}

TEST(Table1Inputs, AHostPlaysRecordingsAgainAndAgain) {
    EXPECT_EQ(played_for_long("folder:table"), "folder:table,loop=1,preload=1");
    EXPECT_EQ(played_for_long("recording:a.mkv,camera=1,loop=0"),
              "recording:a.mkv,camera=1,loop=0,preload=1");
    EXPECT_EQ(played_for_long("synthetic"), "synthetic:preload=1");
    EXPECT_EQ(played_for_long("k4a:0"), "k4a:0");
}

}  // namespace
}  // namespace theatron::bench
