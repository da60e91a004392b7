// SPDX-License-Identifier: Apache-2.0
#include "capture/k4a_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace theatron::capture::k4a {
namespace {

using ::testing::HasSubstr;

Settings settings(std::string_view specification) {
    Options options = Options::parse(specification);
    return take_settings(options);
}

std::string problem_with(std::string_view specification) {
    try {
        settings(specification);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(K4aSettings, UsualOnesAreForASingleCamera) {
    const Settings s = settings("k4a:1");
    EXPECT_EQ(s.index, 1u);
    EXPECT_EQ(s.name(), "k4a:1");
    EXPECT_EQ(s.depth, (Size{640, 576}));
    EXPECT_EQ(s.color, (Size{1280, 720}));
    EXPECT_EQ(s.frames_per_second, 30);
    EXPECT_EQ(s.configuration.sync, SyncRole::standalone);
    EXPECT_FALSE(s.configuration.synchronized_only);
    // The device keeps the settings of other programs, so automatic is set explicitly.
    ASSERT_EQ(s.controls.size(), 2u);
    for (const ControlSetting& control : s.controls)
        EXPECT_EQ(control.mode, ControlMode::automatic);
}

TEST(K4aSettings, EveryOptionReachesTheConfiguration) {
    const Settings s = settings(
        "k4a:0,depth=wfov2x2,color=1080,fps=15,sync=subordinate,delay_us=160,exposure_us=8330,"
        "white_balance=4507,powerline_hz=50,synchronized=1");
    EXPECT_EQ(s.depth, (Size{512, 512}));
    EXPECT_EQ(s.color, (Size{1920, 1080}));
    EXPECT_EQ(s.frames_per_second, 15);
    EXPECT_EQ(s.configuration.sync, SyncRole::subordinate);
    EXPECT_EQ(s.configuration.delay_off_master_us, 160u);
    EXPECT_TRUE(s.configuration.synchronized_only);
    ASSERT_EQ(s.controls.size(), 3u);
    EXPECT_EQ(s.controls[0].value, 8330);
    EXPECT_EQ(s.controls[1].value, 4500);  // a multiple of ten
    EXPECT_EQ(s.controls[2].value, 1);
    EXPECT_EQ(settings("k4a:serial=000123").name(), "k4a:serial=000123");
}

TEST(K4aSettings, WithoutColourThereIsNothingToPairOrToExpose) {
    const Settings s = settings("k4a:0,color=off,synchronized=1,exposure_us=5000");
    EXPECT_EQ(s.color, Size{});
    EXPECT_FALSE(s.configuration.synchronized_only);
    EXPECT_TRUE(s.controls.empty());
}

TEST(K4aSettings, SaysWhatDoesNotGoTogether) {
    EXPECT_THAT(problem_with("k4a:0,depth=wfov"), HasSubstr("at most 15 fps with depth=wfov"));
    EXPECT_THAT(problem_with("k4a:0,color=3072"), HasSubstr("at most 15 fps with color=3072"));
    EXPECT_EQ(problem_with("k4a:0,depth=wfov,fps=15"), "");
    EXPECT_THAT(problem_with("k4a:0,sync=master,color=off"), HasSubstr("sync=master needs colour"));
    EXPECT_THAT(problem_with("k4a:0,delay_us=160"), HasSubstr("needs sync=subordinate"));
    EXPECT_THAT(problem_with("k4a:0,sync=subordinate,delay_us=40000"), HasSubstr("longer than"));
}

TEST(K4aSettings, SaysWhatIsMistyped) {
    EXPECT_THAT(problem_with("k4a:left"), HasSubstr("takes a number, as in k4a:0, not 'left'"));
    EXPECT_THAT(problem_with("k4a:-1"), HasSubstr("takes a number"));
    EXPECT_THAT(problem_with("k4a:0,depth=far"),
                HasSubstr("there are nfov, nfov2x2, wfov2x2, wfov."));
    EXPECT_THAT(problem_with("k4a:0,powerline_hz=40"), HasSubstr("there are 50, 60."));
    EXPECT_THAT(problem_with("k4a:0,exposure_us=dark"), HasSubstr("exposure_us=auto or a number"));
    EXPECT_THAT(problem_with("k4a:0,white_balance=100"), HasSubstr("from 2500 to 12500"));
    EXPECT_THAT(problem_with("k4a:0,lamp=1"), HasSubstr("'lamp' is unknown"));
}

}  // namespace
}  // namespace theatron::capture::k4a
