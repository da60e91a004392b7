// SPDX-License-Identifier: Apache-2.0
// Actions of a person on the case that is open in the room: each function sends requests to the
// host, whose effect is seen at once and undone if the host refuses.
//
// Functions that need an open case, or a part or a screen that it does not have, do nothing and
// return false.
#pragma once

#include "client/participant.h"
#include "session/case_objects.h"

namespace theatron::viewer {

// Opens an offered case in place of the present one, its middle at `place`, upright, its front
// towards `eye`.
bool open_case(client::Participant& participant, const ContentHash& offered, Vec3 place, Vec3 eye);
bool close_case(client::Participant& participant);

// `part`: its number in the case.
bool show_part(client::Participant& participant, std::size_t part, bool shown);
bool set_opacity(client::Participant& participant, std::size_t part, double opacity);

// How far parts are drawn away from the middle: 0 not at all, 1 farthest.
bool explode(client::Participant& participant, double share);
// All parts in their places, shown.
bool put_together(client::Participant& participant);
bool set_scale(client::Participant& participant, double scale);  // 1: life size

bool cut_at_slice(client::Participant& participant, bool cut);
bool set_screen(client::Participant& participant, const session::CaseScreen& screen);
// From now on only this participant, and operators, change the screen; or everybody again.
bool present(client::Participant& participant, bool presents);

}  // namespace theatron::viewer
