// SPDX-License-Identifier: Apache-2.0
// The panel of shared screens: who shares them, and buttons that go to them, change their width,
// pin them and end their shares.
#pragma once

#include "viewer/room_panel.h"

namespace theatron::viewer {

struct ScreenPanelFacts {
    const session::RoomObjects* objects = nullptr;
    ParticipantId self{};
    wire::Role role{};
    std::map<ParticipantId, std::string> names = {};  // of the others
};
// Nothing is added where nobody shares a screen.
void add_screen_panel(const ScreenPanelFacts& facts, RoomPanel& panel);

// The eye (z forward, y down) from which the whole screen is seen, also on a phone that is held
// upright.
Pose in_front_of(const ScreenPlace& screen);

// The person that shares the screen, and operators: pin it, unpin it, end its share.
bool may_decide_on_screen(const session::RoomObject& screen, ParticipantId self, wire::Role role);

// Asks the host for the change. False if there is no such screen any more.
bool change_screen(const ChangeScreen& change, client::Participant& participant);

}  // namespace theatron::viewer
