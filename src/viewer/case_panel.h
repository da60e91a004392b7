// SPDX-License-Identifier: Apache-2.0
// The panel of the case: what the host offers, what is open, its parts, cuts and images, with
// buttons.
#pragma once

#include "viewer/case_scene.h"
#include "viewer/room_panel.h"

namespace theatron::viewer {

struct CasePanelFacts {
    std::vector<wire::OfferedCase> offered;
    const session::CaseInRoom* room = nullptr;  // null: no case is open
    const client::OpenCase* content = nullptr;  // null: nothing of it is known yet
    const medical::Volume* volume = nullptr;    // whose slices the screen shows; may be null
    std::string presenter;                      // the name; empty: everybody changes the screen
    bool presents = false;                      // oneself
    wire::Patient patient;                      // of the open case; empty: not known to this person
};
// Appends a panel and the commands of its buttons.
void add_case_panel(const CasePanelFacts& facts, RoomPanel& panel);

}  // namespace theatron::viewer
