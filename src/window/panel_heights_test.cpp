// SPDX-License-Identifier: Apache-2.0
#include "window/panel_heights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron::window {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(PanelHeights, AreAsWantedWhereThereIsSpace) {
    EXPECT_THAT(panel_heights({100, 300, 50}, 80, 500), ElementsAre(100, 300, 50));
    EXPECT_THAT(panel_heights({}, 80, 500), IsEmpty());
    EXPECT_THAT(panel_heights({400}, 80, 300), ElementsAre(300));
}

TEST(PanelHeights, TheHighestHasHalfOfTheHeightAndWhatTheOthersLeave) {
    EXPECT_THAT(panel_heights({900, 200, 200, 200}, 90, 600), ElementsAre(300, 100, 100, 100));
    EXPECT_THAT(panel_heights({200, 900, 50, 200}, 90, 600), ElementsAre(125, 300, 50, 125));
    EXPECT_THAT(panel_heights({900, 50, 60}, 90, 600), ElementsAre(490, 50, 60));
}

TEST(PanelHeights, AreEqualWhereTheOthersWouldBecomeTooLow) {
    EXPECT_THAT(panel_heights({900, 200, 200, 200}, 110, 600), ElementsAre(150, 150, 150, 150));
    EXPECT_THAT(panel_heights({900, 200, 200, 200}, 160, 600), IsEmpty());
}

}  // namespace
}  // namespace theatron::window
