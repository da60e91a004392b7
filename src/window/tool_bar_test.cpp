// SPDX-License-Identifier: Apache-2.0
#include "window/tool_bar.h"

#include <gtest/gtest.h>

namespace theatron::window {
namespace {

constexpr double text_px = 18;

TEST(ToolBar, CellsLieInTheWindowApartAndLargeEnoughForAFinger) {
    for (const Size window : {Size{1280, 720}, Size{640, 480}, Size{1366, 650}, Size{480, 360}})
        for (const std::size_t tools : {std::size_t(2), std::size_t(8)}) {
            SCOPED_TRACE(std::to_string(window.width) + " " + std::to_string(tools));
            const ToolBarLayout layout = tool_bar_layout(tools, window, text_px);
            std::vector<BarCell> cells{layout.dot};
            cells.insert(cells.end(), layout.tools.begin(), layout.tools.end());
            ASSERT_EQ(cells.size(), tools + 1);
            double free_from = 0;
            for (const BarCell& cell : cells) {
                EXPECT_GE(cell.left, free_from) << "none covers another";
                EXPECT_GE(cell.width(), 40);
                EXPECT_GE(cell.height(), 40);
                EXPECT_LE(cell.right, window.width);
                EXPECT_LE(cell.bottom, window.height);
                EXPECT_GE(cell.top, 0);
                free_from = cell.right;
            }
        }
}

TEST(ToolBar, ANarrowWindowKeepsAllCellsInside) {
    const ToolBarLayout layout = tool_bar_layout(8, {320, 240}, text_px);
    EXPECT_LE(layout.tools.back().right, 320);
    EXPECT_GE(layout.tools.front().left, layout.dot.right);
    EXPECT_FALSE(layout.has_labels);
    EXPECT_TRUE(tool_bar_layout(8, {640, 480}, text_px).has_labels);
}

TEST(ToolBar, TheToolsStandInTheMiddleOfAWideWindow) {
    const ToolBarLayout layout = tool_bar_layout(8, {1920, 1080}, text_px);
    EXPECT_NEAR(layout.tools.front().left + layout.tools.back().right, 1920, 2);
    EXPECT_EQ(layout.dot.left, 0);
}

}  // namespace
}  // namespace theatron::window
