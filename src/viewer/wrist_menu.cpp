// SPDX-License-Identifier: Apache-2.0
#include "viewer/wrist_menu.h"

#include <utility>

#include "phrases/phrase.h"

namespace theatron::viewer {

std::vector<MenuRow> menu_rows(const MenuFacts& facts) {
    std::vector<MenuRow> rows;
    if (!facts.past.empty())
        rows.push_back({MenuAction::live, say(Phrase::menu_live), {}});
    if (facts.studies)
        rows.push_back({MenuAction::panel, say(Phrase::study), {}, Sheet::study});
    rows.push_back({MenuAction::microphone,
                    say(facts.muted             ? Phrase::menu_muted
                        : facts.microphone_open ? Phrase::menu_close_microphone
                                                : Phrase::menu_speak),
                    {}});
    for (const auto& [panel, name] : {std::pair{Sheet::draw, Phrase::tools},
                                      {Sheet::patient_case, Phrase::case_},
                                      {Sheet::people, Phrase::people},
                                      {Sheet::more, Phrase::bar_more}})
        rows.push_back({MenuAction::panel, say(name), {}, panel});
    if (facts.real_room) {
        rows.push_back({MenuAction::place_table, say(Phrase::menu_place_table), {}});
    } else {
        rows.push_back({MenuAction::recentre, say(Phrase::menu_recentre), {}});
        rows.push_back(
            {MenuAction::seat, say(facts.seated ? Phrase::menu_stand : Phrase::menu_sit), {}});
        rows.push_back({MenuAction::turn_left, say(Phrase::menu_turn_left), {}});
        rows.push_back({MenuAction::turn_right, say(Phrase::menu_turn_right), {}});
    }
    rows.push_back({MenuAction::new_brick, say(Phrase::menu_new_brick), {}});
    rows.push_back({MenuAction::drawing, say(Phrase::menu_drawing, facts.drawing), {}});
    std::size_t shown = 0;
    for (const room::RoomPerson& person : facts.people) {
        if (shown++ == most_menu_people)
            break;
        const std::string row =
            facts.real_room ? person.name : say(Phrase::menu_go_to, person.name);
        rows.push_back({MenuAction::go_to_person, person.calls ? say(Phrase::menu_calls, row) : row,
                        person.id});
    }
    if (facts.people.size() > most_menu_people)
        rows.back().text = say(Phrase::menu_more, rows.back().text,
                               std::to_string(facts.people.size() - most_menu_people));
    rows.push_back({MenuAction::leave, say(Phrase::menu_leave), {}});
    return rows;
}

std::vector<PlateRow> plate_rows(const std::vector<MenuRow>& rows) {
    std::vector<PlateRow> plate;
    for (const MenuRow& row : rows)
        plate.push_back({"", false, {{row.text, 0, menu_width_m, int(plate.size())}}});
    return plate;
}

}  // namespace theatron::viewer
