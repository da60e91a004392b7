// SPDX-License-Identifier: Apache-2.0
#include "capture/x11_windows.h"

#include <gtest/gtest.h>

namespace theatron::capture {
namespace {

const X11Window endoscope{0x1e00003, "Endoscope", "Viewer", {640, 480}, 4711};

TEST(SharedWindow, OfTheSameProgramWithTheSameTitleIsOpenedAnew) {
    X11Window found = endoscope;
    EXPECT_TRUE(is_same_window(endoscope, found));
    found.number = 0x2200001;  // the program began anew
    found.process = 4802;
    EXPECT_TRUE(is_same_window(endoscope, found));
}

TEST(SharedWindow, ThatWasAwayMayHaveAnotherTitle) {
    X11Window found = endoscope;
    found.title = "Endoscope (paused)";
    EXPECT_TRUE(is_same_window(endoscope, found));
}

TEST(SharedWindow, OfAnotherTitleOrProgramIsAnother) {
    X11Window found{0x2200001, "Private mail - Endoscope", "Viewer", {640, 480}, 4711};
    EXPECT_FALSE(is_same_window(endoscope, found));
    // The X server gives numbers away again.
    found = {endoscope.number, "Accounts", "Viewer", {640, 480}, 4802};
    EXPECT_FALSE(is_same_window(endoscope, found));
    found = {endoscope.number, endoscope.title, "Browser", {640, 480}, endoscope.process};
    EXPECT_FALSE(is_same_window(endoscope, found));
}

}  // namespace
}  // namespace theatron::capture
