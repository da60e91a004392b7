// SPDX-License-Identifier: Apache-2.0
// The panel of marks: the tool, and what can be removed.
#pragma once

#include "session/mark.h"
#include "viewer/room_panel.h"

namespace theatron::viewer {

// Appends a panel and the commands of its buttons.
void add_mark_panel(const std::optional<session::MarkKind>& tool, bool is_operator,
                    RoomPanel& panel);

}  // namespace theatron::viewer
