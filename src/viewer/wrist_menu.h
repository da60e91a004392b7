// SPDX-License-Identifier: Apache-2.0
// The menu of a person with a headset: a plate at the left wrist whose rows the other hand's ray
// presses.
#pragma once

#include <string>
#include <vector>

#include "room/people.h"
#include "viewer/panels/plate.h"
#include "viewer/sheet.h"

namespace theatron::viewer {

enum class MenuAction {
    microphone,  // opens or closes it
    leave,       // the headset, not the session
    recentre,
    seat,  // sitting people see from the height of standing ones, or no longer do
    drawing,
    turn_left,
    turn_right,
    new_brick,
    place_table,  // with the real room around
    go_to_person,
    panel,
    live,  // ends looking back
};

struct MenuRow {
    MenuAction action{};
    std::string text;
    ParticipantId person{};  // of go_to_person
    Sheet panel{};           // of panel
    bool operator==(const MenuRow&) const = default;
};

struct MenuFacts {
    bool microphone_open = false, muted = false;
    bool seated = false;
    bool real_room = false;
    std::string drawing;
    std::vector<room::RoomPerson> people;  // the others
    std::string past = {};                 // as in Facts
    bool studies = false;                  // the person takes part in a study
};

// At most `most_menu_people` rows name people; the last one's text says how many more there are.
inline constexpr std::size_t most_menu_people = 6;
std::vector<MenuRow> menu_rows(const MenuFacts& facts);

// Each row is one button, whose command is the row's number.
inline constexpr double menu_width_m = 0.28;
std::vector<PlateRow> plate_rows(const std::vector<MenuRow>& rows);

}  // namespace theatron::viewer
