// SPDX-License-Identifier: Apache-2.0
// The panel of the case: what the host offers, what is open, its parts, cuts and images, with
// buttons.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/case_scene.h"
#include "viewer/room_panel.h"

namespace theatron::viewer {

// A case that a person is about to open.
struct AskedCase {
    ContentHash offered;
    bool is_answered = false;  // whose it is, as far as this person may know it
    wire::Patient patient;     // empty: not known to this person
};
struct CasePanelFacts {
    std::vector<wire::OfferedCase> offered;
    const session::CaseInRoom* room = nullptr;  // null: no case is open
    const client::OpenCase* content = nullptr;  // null: nothing of it is known yet
    const medical::Volume* volume = nullptr;    // whose slices the screen shows; may be null
    std::string presenter;                      // the name; empty: everybody changes the screen
    bool presents = false;                      // oneself
    wire::Patient patient;                      // of the open case; empty: not known to this person
    std::optional<AskedCase> asked;             // whether it is to be opened
};
// Appends a panel and the commands of its buttons.
void add_case_panel(const CasePanelFacts& facts, RoomPanel& panel);

}  // namespace theatron::viewer
