// SPDX-License-Identifier: Apache-2.0
#include "viewer/panels/plate.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

constexpr double width_m = 0.5;

std::vector<int> commands_of(const std::vector<PlateRow>& rows) {
    std::vector<int> commands;
    for (const PlateRow& row : rows)
        for (const PlateButton& button : row.buttons)
            commands.push_back(button.command);
    return commands;
}

TEST(Plate, ARayPressesTheButtonThatItMeetsFromTheFront) {
    Plate plate(width_m);
    plate.set_rows({{"", false, {}},
                    {"", false, {{"left", 0, 0.2, 7}, {"right", 0.3, 0.2, 8}}},
                    {"", false, {}}});
    plate.place({0, 1, -0.5}, {0, 1.045, 0});
    const double middle = 1 + 1.5 * Plate::row_m;
    const render::PickRay ray{{-0.1, middle, 0}, {0, 0, -2}};
    EXPECT_FALSE(plate.pick(ray)) << "it is not shown";
    plate.show(true);
    const auto hit = plate.pick(ray);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->command, 7);
    EXPECT_NEAR(hit->distance_m, 0.5, 1e-9);
    EXPECT_EQ(plate.pick({{0.1, middle, 0}, {0, 0, -1}})->command, 8);
    EXPECT_EQ(plate.pick({{0, middle, 0}, {0, 0, -1}})->command, Plate::no_command);
    EXPECT_FALSE(plate.pick({{-0.1, middle, -1}, {0, 0, 1}}));
    EXPECT_FALSE(plate.pick({{width_m, middle, 0}, {0, 0, -1}}));
    EXPECT_FALSE(plate.pick({{0, 1 + 3.5 * Plate::row_m, 0}, {0, 0, -1}}));
}

TEST(Plate, EachButtonOfAPanelIsOnThePlateAndNoneOverlapsAnother) {
    window::Panel panel{"Case", {}};
    window::PanelRow wide{"A long row of text that fills the plate's whole width", "detail", {}};
    for (int i = 0; i < 9; ++i)
        wide.buttons.push_back({"Button " + std::to_string(i), i});
    panel.rows.push_back(wide);
    std::size_t first = 0;
    const auto rows = plate_rows({panel}, width_m, first);
    EXPECT_EQ(commands_of(rows), (std::vector{int(close_plate), 0, 1, 2, 3, 4, 5, 6, 7, 8}));
    for (const PlateRow& row : rows) {
        double end = 0;
        for (const PlateButton& button : row.buttons) {
            EXPECT_GE(button.left_m, end);
            end = button.left_m + button.width_m;
        }
        EXPECT_LE(end, width_m);
    }
}

TEST(Plate, ManyRowsAreShownInTurn) {
    window::Panel panel{"Parts", {}};
    for (int i = 0; i < 40; ++i)
        panel.rows.push_back({"Part", "", {{"Hide", i}}});
    std::size_t first = 0;
    std::vector<int> seen;
    for (std::size_t pages = 0; pages < 3; ++pages) {
        const auto rows = plate_rows({panel}, width_m, first);
        EXPECT_LE(rows.size(), most_plate_rows);
        for (const int command : commands_of(rows))
            if (command >= 0)
                seen.push_back(command);
        first += rows.size() - 2;
    }
    ASSERT_EQ(seen.size(), 40u);
    EXPECT_EQ(seen.back(), 39);
    first = 1000;
    EXPECT_EQ(commands_of(plate_rows({panel}, width_m, first)).at(1), 32) << "the last ones";
}

}  // namespace
}  // namespace theatron::viewer
