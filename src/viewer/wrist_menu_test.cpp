// SPDX-License-Identifier: Apache-2.0
#include "viewer/wrist_menu.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace theatron::viewer {
namespace {

room::RoomPerson person(unsigned id, const std::string& name) {
    room::RoomPerson person;
    person.id = ParticipantId{id};
    person.name = name;
    return person;
}

bool has(const std::vector<MenuRow>& rows, MenuAction action) {
    return std::any_of(rows.begin(), rows.end(),
                       [&](const MenuRow& row) { return row.action == action; });
}

TEST(WristMenu, TheRealRoomDoesNotMoveAndItsTableCanBePlacedAgain) {
    MenuFacts facts;
    EXPECT_TRUE(has(menu_rows(facts), MenuAction::recentre));
    EXPECT_FALSE(has(menu_rows(facts), MenuAction::place_table));
    facts.real_room = true;
    EXPECT_FALSE(has(menu_rows(facts), MenuAction::turn_left));
    EXPECT_TRUE(has(menu_rows(facts), MenuAction::place_table));
}

TEST(WristMenu, ManyPeopleAreCountedAndLeavingStaysTheLastRow) {
    MenuFacts facts;
    for (unsigned id = 1; id <= most_menu_people + 2; ++id)
        facts.people.push_back(person(id, "P" + std::to_string(id)));
    const std::vector<MenuRow> rows = menu_rows(facts);
    EXPECT_EQ(rows.back().action, MenuAction::leave);
    EXPECT_EQ(rows[rows.size() - 2].text, "Go to P6, and 2 more");
    EXPECT_EQ(rows[rows.size() - 2].person, ParticipantId{6});
}

TEST(WristMenu, ARayChoosesTheRowThatItMeetsFromTheFront) {
    WristMenu menu;
    const std::vector<MenuRow> rows(4);
    menu.set(rows, {0, 1, -0.5}, {0, 1.6, 0});
    const double second_from_below = 1 + 1.5 * WristMenu::row_m;
    const render::PickRay ray{{0, second_from_below, 0}, {0, 0, -2}};
    EXPECT_FALSE(menu.pick(ray));  // it is not shown
    menu.show(true);
    const auto hit = menu.pick(ray);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->row, 2u);
    EXPECT_NEAR(hit->distance_m, 0.5, 1e-9);
    EXPECT_FALSE(menu.pick({{0, second_from_below, -1}, {0, 0, 1}}));
    EXPECT_FALSE(menu.pick({{WristMenu::width_m, second_from_below, 0}, {0, 0, -1}}));
    EXPECT_FALSE(menu.pick({{0, 1 + 4.5 * WristMenu::row_m, 0}, {0, 0, -1}}));
}

}  // namespace
}  // namespace theatron::viewer
