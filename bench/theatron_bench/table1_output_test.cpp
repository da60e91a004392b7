// SPDX-License-Identifier: Apache-2.0
#include "table1_output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "table1_page.h"

namespace theatron::bench {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// Given measurements; no row has been measured by this test.
Table1Measured given_machine() {
    Table1Measured measured;
    measured.processor = "Some Processor";
    measured.cores = 2;
    measured.gpu = "llvmpipe";
    measured.runs = 3;
    measured.frames = 60;
    measured.samples["depth/full/zstd1_raw/encode_ms"] = {2.0, 2.2, 2.1};
    measured.samples["depth/full/zstd1_raw/decode_ms"] = {0.8, 0.8, 0.8};
    measured.samples["depth/full/zstd1_raw/kb"] = {400};
    return measured;
}

std::vector<Table1Row> given_rows() {
    Table1Row size{"depth.trvl.full.size",
                   "Depth",
                   "tRVL, full, a picture",
                   "kB",
                   96.6,
                   96.6,
                   {"trvl, lossless", Table1Spread{257.3, 250, 260, 3}, ""},
                   {"strata, lossless", Table1Spread{105.68, 105.68, 105.68, 3}, ""},
                   "depth, of \"room\", 640x576",
                   "any",
                   {"Another scene.", "The paper's is lossy."}};
    Table1Row photon{"delay.photon",
                     "Delay",
                     "Motion to <photon>",
                     "ms",
                     120,
                     150,
                     {"from a movement", {}, "It needs a camera, and a screen."},
                     {},
                     "",
                     "Some Processor, 2 cores",
                     {"Another scene."}};
    Table1Row error{"depth.h264.full.error",
                    "Depth",
                    "H.264, full, error",
                    "mm",
                    {},
                    {},
                    {"h264:crf=10", Table1Spread{3.456, 3.4, 3.5, 3}, ""},
                    {"strata, lossless", Table1Spread{0, 0, 0, 3}, ""},
                    "depth",
                    "any",
                    {}};
    return {size, error, photon};
}

TEST(Table1Text, IsATableWithNotesAndReasons) {
    EXPECT_EQ(table1_text(given_machine(), given_rows()),
              "Fischer et al., Evaluation of Point Cloud Streaming and Rendering for VR-based "
              "Telepresence in the OR (EuroXR 2022), Table 1 and text\n"
              "Paper: Intel i7-7800X, GeForce RTX 2070, Windows 10, Unreal Engine 4.26, HTC Vive "
              "Pro Eye, Azure Kinect.\n"
              "Here: Some Processor, 2 cores; GL: llvmpipe.\n"
              "Medians of 3 runs, with the lowest and the highest; codecs and filters have 60 "
              "pictures of each kind. 1 kB is 1024 bytes, as in the paper.\n"
              "Yardstick for other machines: zstd level 1 on the depth's pixels, 2.10 ms to "
              "compress, 0.80 ms to decompress.\n"
              "\n"
              "Depth                                         unit  paper       here, paper's "
              "method      here, Theatron's choice   notes\n"
              "  tRVL, full, a picture                       kB    96.6        257 (250 to 260)   "
              "       106                       1,2\n"
              "  H.264, full, error                          mm    -           3.46 (3.40 to "
              "3.50)       0                         \n"
              "\n"
              "Delay                                         unit  paper       here, paper's "
              "method      here, Theatron's choice   notes\n"
              "  Motion to <photon>                          ms    120 to 150  -                  "
              "       -                         1\n"
              "    no figure: It needs a camera, and a screen.\n"
              "\n"
              "Why a figure here cannot be compared with the paper's:\n"
              "  1 Another scene.\n"
              "  2 The paper's is lossy.\n");
}

TEST(Table1Csv, HasALineForEachRow) {
    EXPECT_EQ(table1_csv(given_rows()),
              "id,group,row,unit,paper_low,paper_high,same_ran,same_median,same_low,same_high,"
              "same_runs,same_reason,best_ran,best_median,best_low,best_high,best_runs,"
              "best_reason,input,device,not_comparable\n"
              "depth.trvl.full.size,Depth,\"tRVL, full, a picture\",kB,96.6,96.6,\"trvl, "
              "lossless\",257.3,250,260,3,,\"strata, lossless\",105.68,105.68,105.68,3,,"
              "\"depth, of \"\"room\"\", 640x576\",any,Another scene. The paper's is lossy.\n"
              "depth.h264.full.error,Depth,\"H.264, full, error\",mm,,,h264:crf=10,3.456,3.4,3.5,"
              "3,,\"strata, lossless\",0,0,0,3,,depth,any,\n"
              "delay.photon,Delay,Motion to <photon>,ms,120,150,from a movement,,,,,\"It needs a "
              "camera, and a screen.\",,,,,,,,\"Some Processor, 2 cores\",Another scene.\n");
}

TEST(Table1Json, HasEachRowAndTheMachine) {
    const nlohmann::json json = table1_json(given_machine(), given_rows());
    EXPECT_EQ(json["here"], nlohmann::json::parse(R"({
        "processor": "Some Processor", "cores": 2, "gl_renderer": "llvmpipe",
        "cores_of_others": 0.0, "runs": 3, "frames": 60, "part_seconds": {},
        "yardstick": {"name": "zstd1_raw", "encode_ms": 2.1, "decode_ms": 0.8, "kb": 400.0}})"));
    EXPECT_EQ(json["bytes_per_kb"], 1024);
    EXPECT_EQ(json["rows"], nlohmann::json::parse(R"([
        {"id": "depth.trvl.full.size", "group": "Depth", "name": "tRVL, full, a picture",
         "unit": "kB", "paper": {"low": 96.6, "high": 96.6},
         "same": {"ran": "trvl, lossless", "median": 257.3, "low": 250.0, "high": 260.0, "runs": 3},
         "best": {"ran": "strata, lossless", "median": 105.68, "low": 105.68, "high": 105.68,
                  "runs": 3},
         "input": "depth, of \"room\", 640x576", "device": "any",
         "not_comparable": ["Another scene.", "The paper's is lossy."]},
        {"id": "depth.h264.full.error", "group": "Depth", "name": "H.264, full, error",
         "unit": "mm", "paper": null,
         "same": {"ran": "h264:crf=10", "median": 3.456, "low": 3.4, "high": 3.5, "runs": 3},
         "best": {"ran": "strata, lossless", "median": 0.0, "low": 0.0, "high": 0.0, "runs": 3},
         "input": "depth", "device": "any", "not_comparable": []},
        {"id": "delay.photon", "group": "Delay", "name": "Motion to <photon>", "unit": "ms",
         "paper": {"low": 120.0, "high": 150.0},
         "same": {"ran": "from a movement", "reason": "It needs a camera, and a screen."},
         "best": null, "input": "", "device": "Some Processor, 2 cores",
         "not_comparable": ["Another scene."]}])"));
    EXPECT_EQ(table1_json({}, {})["here"]["gl_renderer"], nullptr);
    EXPECT_EQ(table1_json({}, {})["here"]["yardstick"], nullptr);
}

TEST(Table1Text, OtherProgramsAreSaid) {
    Table1Measured measured = given_machine();
    EXPECT_THAT(table1_text(measured, {}), Not(HasSubstr("Other programs")));
    measured.cores_of_others = 1.4;
    EXPECT_THAT(table1_text(measured, {}), HasSubstr("Other programs used 1.4 cores"));
}

TEST(Table1Text, EachPartHasItsTime) {
    Table1Measured measured = given_machine();
    EXPECT_THAT(table1_text(measured, {}), Not(HasSubstr("It took")));
    measured.part_seconds = {{"the input", 61.4}, {"filters", 2.5}};
    EXPECT_THAT(table1_text(measured, {}), HasSubstr("It took 64 s: the input 61, filters 2.\n"));
    EXPECT_EQ(table1_json(measured, {})["here"]["part_seconds"]["the input"], 61.4);
}

TEST(Table1Text, FiguresHaveThreeDigitsThatCount) {
    EXPECT_EQ(figure_text(0.987), "0.99");
    EXPECT_EQ(figure_text(9.996), "10.0");
    EXPECT_EQ(figure_text(99.96), "100");
    EXPECT_EQ(figure_text(3555.4), "3555");
}

TEST(Table1Plot, PutsThePaperTheMethodAndTheChoiceOnOneAxis) {
    const std::vector<Table1Row> rows = given_rows();
    EXPECT_EQ(
        table1_plot({&rows[0]}),
        "<svg xmlns='http://www.w3.org/2000/svg' width='780' height='88' viewBox='0 0 780 88' "
        "font-family='sans-serif' font-size='11'>\n"
        "<rect width='780' height='88' fill='#ffffff'/>\n"
        "<line x1='340.8' y1='14.0' x2='340.8' y2='48.0' stroke='#e3e3e3' stroke-width='1.0'/>\n"
        "<text x='340.8' y='62.0' text-anchor='middle' >100</text>\n"
        "<line x1='585.0' y1='14.0' x2='585.0' y2='48.0' stroke='#e3e3e3' stroke-width='1.0'/>\n"
        "<text x='585.0' y='62.0' text-anchor='middle' >200</text>\n"
        "<text x='503.0' y='78.0' text-anchor='middle' fill='#555555'>kB, logarithmic; to the left "
        "is smaller</text>\n"
        "<text x='240.0' y='35.0' text-anchor='end' >tRVL, full, a picture</text>\n"
        "<line x1='328.6' y1='22.0' x2='328.6' y2='22.0' stroke='#b35900' stroke-width='2.0'/>\n"
        "<path d='M323.6 22.0L328.6 17.0L333.6 22.0L328.6 27.0Z' fill='#b35900'/>\n"
        "<line x1='663.6' y1='31.0' x2='677.4' y2='31.0' stroke='#1f5fa8' stroke-width='2.0'/>\n"
        "<circle cx='673.7' cy='31.0' r='4' stroke='#1f5fa8' stroke-width='1.5' fill='#ffffff'/>\n"
        "<line x1='360.3' y1='40.0' x2='360.3' y2='40.0' stroke='#1f5fa8' stroke-width='2.0'/>\n"
        "<circle cx='360.3' cy='40.0' r='4' stroke='#1f5fa8' stroke-width='1.5' fill='#1f5fa8'/>\n"
        "</svg>\n");
}

TEST(Table1Plot, IsEmptyWithoutAFigure) {
    const Table1Row row{.id = "x", .group = "g", .name = "n", .unit = "ms"};
    EXPECT_EQ(table1_plot({&row}), "");
}

TEST(Table1Page, HoldsAllInOneFile) {
    const std::string page = table1_page(given_machine(), given_rows());
    EXPECT_THAT(page, StartsWith("<!doctype html>\n"));
    // No script, and nothing is loaded from elsewhere but the name of SVG's own format.
    for (const char* outside : {"<script", "src=", "<link", "@import", "url("})
        EXPECT_THAT(page, Not(HasSubstr(outside)));
    EXPECT_THAT(page,
                HasSubstr("<tr><td>tRVL, full, a picture</td><td>kB</td><td class=\"number\">96.6"
                          "</td><td>257 (250 to 260)<small>trvl, lossless</small></td>"
                          "<td>106<small>strata, lossless</small></td><td><small>any; depth, of "
                          "&quot;room&quot;, 640x576</small></td><td><a href=\"#note1\">1</a>, "
                          "<a href=\"#note2\">2</a></td></tr>\n"));
    EXPECT_THAT(page, HasSubstr("<td>Motion to &lt;photon&gt;</td><td>ms</td>"
                                "<td class=\"number\">120 to 150</td><td>It needs a camera, and a "
                                "screen.</td><td>-</td>"));
    EXPECT_THAT(page, HasSubstr("<li id=\"note2\">The paper&#39;s is lossy.</li>"));
    EXPECT_THAT(page, HasSubstr("A depth picture takes 106 kB"));
    EXPECT_THAT(page, HasSubstr("<figcaption><b>Delay, ms</b></figcaption>"));
    EXPECT_THAT(page, Not(HasSubstr("<figcaption><b>Depth, mm</b></figcaption>")));
}

Table1Measured with_stages() {
    Table1Measured measured = given_machine();
    measured.stages = {{"encoded", "host: encoding", 8.25}, {"presented", "drawing", 20}};
    return measured;
}

TEST(Table1Stages, AreInTextJsonAndPage) {
    const std::vector<Table1Row> rows = given_rows();
    EXPECT_THAT(table1_text(with_stages(), rows), HasSubstr("\n  20.0 ms     drawing\n"));
    const nlohmann::json stages = table1_json(with_stages(), rows)["stages"];
    ASSERT_EQ(stages.size(), 2u);
    EXPECT_EQ(stages[0]["until"], "encoded");
    EXPECT_EQ(stages[0]["mean_ms"], 8.25);
    EXPECT_THAT(table1_page(with_stages(), rows), HasSubstr("28.2 ms in all"));
}

TEST(Table1Stages, AreLeftOutWhereNothingWasMeasured) {
    const std::vector<Table1Row> rows = given_rows();
    EXPECT_THAT(table1_text(given_machine(), rows), Not(HasSubstr("Mean age")));
    EXPECT_TRUE(table1_json(given_machine(), rows)["stages"].empty());
    EXPECT_THAT(table1_page(given_machine(), rows), Not(HasSubstr("Where the time goes")));
}

TEST(Table1Page, TheAgeInsideTheSystemIsNotThePapersFigure) {
    std::vector<Table1Row> rows = given_rows();
    rows.push_back({"delay.inside",
                    "Delay",
                    "Whole system with a synthetic camera, without display",
                    "ms",
                    {},
                    {},
                    {},
                    {"photon read", Table1Spread{41.5, 41, 42, 3}, ""},
                    "",
                    "",
                    {}});
    const std::string page = table1_page(given_machine(), rows);
    EXPECT_THAT(page, HasSubstr("synthetic camera, without display: a picture is 41.5 ms old when "
                                "it is drawn. The paper filmed 120 to 150 ms; less the 75 ms of "
                                "its camera these are 45 to 75 ms"));
}

}  // namespace
}  // namespace theatron::bench
