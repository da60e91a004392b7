// SPDX-License-Identifier: Apache-2.0
#include "viewer/shared_screens.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

using wire::CameraCondition;

wire::CameraState in(CameraCondition condition) {
    wire::CameraState state;
    state.condition = condition;
    return state;
}

TEST(ScreenCaptionTest, AScreenShowsItsNameAndAge) {
    EXPECT_EQ(screen_caption("endoscope", in(CameraCondition::live), 85),
              (ScreenCaption{"endoscope  85 ms", false}));
}

TEST(ScreenCaptionTest, AScreenWithoutPicturesOrWithOldOnesSaysSo) {
    EXPECT_EQ(screen_caption("e", in(CameraCondition::live), std::nullopt),
              (ScreenCaption{"e: no picture yet", true}));
    EXPECT_EQ(screen_caption("e", in(CameraCondition::live), 3000),
              (ScreenCaption{"e: stands still for 3 s", true}));
    EXPECT_EQ(screen_caption("e", in(CameraCondition::ended), 85),
              (ScreenCaption{"e: has ended, this is its last picture", true}));
    EXPECT_EQ(screen_caption("e", in(CameraCondition::failed), std::nullopt),
              (ScreenCaption{"e: has failed", true}));
}

}  // namespace
}  // namespace theatron::viewer
