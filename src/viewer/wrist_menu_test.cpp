// SPDX-License-Identifier: Apache-2.0
#include "viewer/wrist_menu.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "base/utf8.h"
#include "phrases/phrase.h"
#include "render/glyphs.h"
#include "testing/speaking.h"

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

// The headset writes with the letters of the font's atlas; the page and the window have others.
bool can_be_written_in_the_room(std::string_view text) {
    while (!text.empty()) {
        const Utf8Character letter = first_character(text);
        if (!letter.valid || (!render::is_in_atlas(letter.code) && letter.code != U'\n'))
            return false;
        text.remove_prefix(letter.bytes);
    }
    return true;
}

TEST(WristMenu, AllNotesHaveLettersInTheRoomInEveryLanguage) {
    const std::pair<Phrase, const char*> all[] = {
#define PHRASE(key, ...) {Phrase::key, #key},
#include "phrases/connection.inc"
#include "phrases/meeting.inc"
#include "phrases/pictures.inc"
#include "phrases/study.inc"
#include "phrases/window.inc"
#undef PHRASE
    };
    // Messages over the picture, which the headset has as phrases of its own.
    const std::set<Phrase> messages{Phrase::waits_for_picture, Phrase::connecting,
                                    Phrase::waits_at_door, Phrase::lost_connection,
                                    Phrase::no_connection_yet};
    for (const auto& [phrase, key] : all)
        for (const LanguageFacts& facts : languages)
            EXPECT_TRUE(messages.contains(phrase) ||
                        can_be_written_in_the_room(
                            sentence_of(phrase).in(parse_language(facts.code).value())))
                << key << " in " << facts.name;
}

TEST(WristMenu, SpeaksEveryLanguageAndItsRowsAreShort) {
    const std::map<Language, std::string> last_rows{
        {Language::english, "Take off the headset's view"},
        {Language::german, "Das Headset verlassen"},
        {Language::french, "Quitter la vue du casque"}};
    for (const auto& [language, last_row] : last_rows) {
        const testing::Speaking spoken(language);
        MenuFacts facts;
        facts.drawing = say(Phrase::drawn_automatically, "splat");
        std::vector<MenuRow> rows = menu_rows(facts);
        facts.real_room = facts.muted = true;
        facts.past = "before";
        for (const MenuRow& row : menu_rows(facts))
            rows.push_back(row);
        for (const MenuRow& row : rows)
            EXPECT_LE(row.text.size(), 36u) << row.text << " is wider than the menu";
        EXPECT_EQ(rows.back().text, last_row);
    }
    EXPECT_EQ(last_rows.size(), language_count);
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

TEST(WristMenu, HasThePanels) {
    for (const Sheet panel : {Sheet::draw, Sheet::patient_case, Sheet::people, Sheet::more}) {
        const std::vector<MenuRow> rows = menu_rows({});
        EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [&](const MenuRow& row) {
            return row.action == MenuAction::panel && row.panel == panel;
        }));
    }
}

TEST(WristMenu, EachRowIsAButton) {
    MenuFacts facts;
    const std::vector<MenuRow> rows = menu_rows(facts);
    const std::vector<PlateRow> plate = plate_rows(rows);
    ASSERT_EQ(plate.size(), rows.size());
    for (std::size_t i = 0; i < plate.size(); ++i) {
        EXPECT_EQ(plate[i].buttons.at(0).command, int(i));
        EXPECT_EQ(plate[i].buttons.at(0).text, rows[i].text);
    }
}

}  // namespace
}  // namespace theatron::viewer
