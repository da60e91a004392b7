// SPDX-License-Identifier: Apache-2.0
#include "filter/chain_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron::filter {
namespace {

using testing::HasSubstr;

ChainSettings good(const ParsedChain& parsed) {
    EXPECT_EQ(parsed.problem, "");
    return parsed.settings;
}

TEST(ChainSettings, OffSpellsNothing) {
    EXPECT_EQ(good(parse_chain("off")).spelling(), "");
    EXPECT_TRUE(good(parse_chain("")).off());
    EXPECT_FALSE(good(parse_chain("paper")).off());
}

TEST(ChainSettings, TheSpellingSaysWhatDiffersFromTheUsual) {
    EXPECT_EQ(good(parse_chain("range:max_mm=3000,min_mm=0+holes:iterations=4+kalman")).spelling(),
              "range:max_mm=3000+holes+kalman");
}

TEST(ChainSettings, PresetsAreChainsOfTheirOwn) {
    EXPECT_EQ(good(parse_chain("default")).spelling(), "holes+flying_pixels+kalman");
    EXPECT_EQ(good(parse_chain("stereo")).spelling(), "holes+flying_pixels+steady");
    EXPECT_EQ(good(parse_chain_json(R"({"preset": "stereo",
                                        "filters": [{"filter": "steady", "frames": 5}]})"))
                  .spelling(),
              "holes+flying_pixels+steady:frames=5");
}

TEST(ChainSettings, ASpellingReadsBackAsItself) {
    for (const char* text :
         {"paper", "default", "stereo+kalman:gain_1000=90", "steady:frames=3,squared_mm=15",
          "speckles:max_pixels=9+range:min_mm=200",
          "holes+holes:max_size=3+background:margin_sigmas=0"}) {
        const ChainSettings settings = good(parse_chain(text));
        EXPECT_EQ(good(parse_chain(settings.spelling())).steps, settings.steps) << text;
    }
}

TEST(ChainSettings, StepsBehindAPresetChangeIt) {
    EXPECT_EQ(good(parse_chain("paper+range:max_mm=2000")).spelling(),
              "range:max_mm=2000+holes+kalman");
    const ChainSettings settings =
        good(parse_chain("default+background:file=/a,b/room.background"));
    EXPECT_TRUE(settings.needs_background());
    EXPECT_TRUE(std::holds_alternative<BackgroundParams>(settings.steps.front()));
    EXPECT_EQ(settings.background_file, "/a,b/room.background");
    EXPECT_THAT(settings.spelling(), testing::StartsWith("background+"));
}

TEST(ChainSettings, ADeviceMayBeChosenAtTheEnd) {
    EXPECT_EQ(good(parse_chain("default")).device, Device::processor);
    EXPECT_EQ(good(parse_chain("default@cpu")).device, Device::processor);
    EXPECT_EQ(good(parse_chain("default+range:max_mm=2000@cuda")).device, Device::cuda);
    EXPECT_EQ(good(parse_chain("paper@auto")).device, Device::quickest);
    EXPECT_EQ(good(parse_chain("paper@auto")).spelling(), good(parse_chain("paper")).spelling());
    EXPECT_EQ(good(parse_chain_json(R"({"preset": "paper", "device": "cuda"})")).device,
              Device::cuda);
    EXPECT_EQ(good(parse_chain("default+background:file=me@or3.background")).background_file,
              "me@or3.background");
    const ChainSettings both = good(parse_chain("background:file=me@or3.background@cuda"));
    EXPECT_EQ(both.background_file, "me@or3.background");
    EXPECT_EQ(both.device, Device::cuda);
    for (const char* text : {"default@gpu", "default@", "@cuda@x"})
        EXPECT_THAT(parse_chain(text).problem, HasSubstr("there are cpu, cuda and auto")) << text;
    EXPECT_EQ(parse_chain("default@cuda+range:max_mm=2000").problem,
              "The device stands at the end of the line: 'default+range:max_mm=2000@cuda'.");
    for (const char* text : {"off@cuda", "off@auto"})
        EXPECT_EQ(parse_chain(text).problem,
                  "There are no filters to run on a GPU: leave the device out.");
    EXPECT_EQ(parse_chain("off@cpu").problem, "");
}

TEST(ChainSettings, AFileSaysTheSame) {
    const ChainSettings settings = good(parse_chain_json(R"({
        // The camera above the table.
        "preset": "paper",
        "filters": [{"filter": "range", "max_mm": 2000},
                    {"filter": "background", "file": "room.background", "margin_mm": 30}]
    })"));
    EXPECT_EQ(settings.spelling(), "background:margin_mm=30+range:max_mm=2000+holes+kalman");
    EXPECT_EQ(settings.background_file, "room.background");
    EXPECT_EQ(good(parse_chain_json(R"({"filters": []})")).spelling(), "");
}

TEST(ChainSettings, WhatIsWrongIsSaidInOneSentence) {
    const auto problem = [](const char* text) { return parse_chain(text).problem; };
    EXPECT_THAT(problem("best"), HasSubstr("There is no filter 'best'"));
    EXPECT_THAT(problem("holes:depth=3"), HasSubstr("depth"));
    EXPECT_THAT(problem("holes:iterations=0"), HasSubstr("1 to 64"));
    EXPECT_THAT(problem("holes+"), HasSubstr("There is no filter ''"));
    EXPECT_THAT(problem("holes:4"), HasSubstr("'4' is not a key=value pair"));
    EXPECT_THAT(problem("range:min_mm=500,max_mm=400"), HasSubstr("keeps nothing"));
    std::string many = "holes";
    for (int i = 0; i < 20; ++i)
        many += "+holes";
    EXPECT_THAT(problem(many.c_str()), HasSubstr("at most 16"));
}

TEST(ChainSettings, WhatIsWrongInAFileIsSaidInOneSentence) {
    const auto problem = [](const char* text) { return parse_chain_json(text).problem; };
    EXPECT_THAT(problem("{"), HasSubstr("not a JSON object"));
    EXPECT_THAT(problem("[]"), HasSubstr("not a JSON object"));
    EXPECT_THAT(problem(R"({"device": "gpu"})"), HasSubstr("there are cpu, cuda and auto"));
    EXPECT_THAT(problem(R"({"device": 1})"), HasSubstr("one of cpu, cuda and auto"));
    EXPECT_THAT(problem(R"({"preset": 3})"), HasSubstr("one of off, paper, default and stereo"));
    EXPECT_THAT(problem(R"({"filter": "holes"})"), HasSubstr("no use for 'filter'"));
    EXPECT_THAT(problem(R"({"filters": {}})"), HasSubstr("list"));
    EXPECT_THAT(problem(R"({"filters": [3]})"), HasSubstr("object that names it"));
    EXPECT_THAT(problem(R"({"filters": [{"filter": "x"}]})"), HasSubstr("There is no filter 'x'"));
    EXPECT_THAT(problem(R"({"filters": [{"filter": "holes", "x": 1}]})"),
                HasSubstr("parameter 'x'"));
    EXPECT_THAT(problem(R"({"filters": [{"filter": "holes", "max_size": 1.5}]})"),
                HasSubstr("whole number from 1 to 31"));
    EXPECT_THAT(problem(R"({"filters": [{"filter": "holes", "max_size": 99999999999999}]})"),
                HasSubstr("whole number from 1 to 31"));
}

}  // namespace
}  // namespace theatron::filter
