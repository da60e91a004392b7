// SPDX-License-Identifier: Apache-2.0
// The panel of tools: which one the pointer is, and the marks that can be removed.
#pragma once

#include "viewer/room_panel.h"

namespace theatron::viewer {

struct ToolPanelFacts {
    ToolKind chosen{};
    bool has_case = false;   // one is open
    bool has_hands = false;  // with a headset: a tool can be put away
    bool is_operator = false;
};
// Appends a panel and the commands of its buttons.
void add_tool_panel(const ToolPanelFacts& facts, RoomPanel& panel);

}  // namespace theatron::viewer
