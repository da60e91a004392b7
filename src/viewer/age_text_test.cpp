// SPDX-License-Identifier: Apache-2.0
#include "viewer/age_text.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

TEST(PictureTitle, TellsTheAgeAndThatAPictureIsNotLive) {
    EXPECT_EQ(picture_title("left, colour", 85, true), "left, colour  85 ms");
    EXPECT_EQ(picture_title("left, colour", 23'400, false), "left, colour  NOT LIVE: 23 s old");
    EXPECT_EQ(picture_title("left, colour", std::nullopt, true), "left, colour");
    EXPECT_EQ(picture_title("left, colour", std::nullopt, false), "left, colour  NOT LIVE");
}

}  // namespace
}  // namespace theatron::viewer
