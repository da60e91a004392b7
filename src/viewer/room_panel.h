// SPDX-License-Identifier: Apache-2.0
// The panel of people and places: who is here, what they hold, and buttons to go to them.
#pragma once

#include <variant>
#include <vector>

#include "viewer/meeting.h"
#include "viewer/places.h"
#include "xr/overlay_content.h"

namespace theatron::viewer {

// The commands of the panel's buttons.
struct GoToPerson {
    ParticipantId person{};
};
struct LookThrough {
    ParticipantId person{};
};
struct GoToPlace {
    Place place;
};
using RoomCommand = std::variant<GoToPerson, LookThrough, GoToPlace>;

struct RoomPanel {
    std::vector<xr::Panel> panels;
    std::vector<RoomCommand> commands;  // by the number in xr::PanelButton
};

// `followed` is the person through whose eyes the user sees, if any.
RoomPanel room_panel(const client::Participant::Room& room,
                     const std::vector<room::RoomPerson>& people, const std::vector<Place>& places,
                     std::optional<ParticipantId> followed);

}  // namespace theatron::viewer
