// SPDX-License-Identifier: Apache-2.0
#include "viewer/mark_panel.h"

#include <utility>

#include "viewer/mark_actions.h"

namespace theatron::viewer {

using session::MarkKind;

void add_mark_panel(const std::optional<MarkKind>& tool, bool is_operator, RoomPanel& panel) {
    const auto button = [&](std::string label, RoomCommand command) {
        panel.commands.push_back(std::move(command));
        return xr::PanelButton{std::move(label), int(panel.commands.size()) - 1};
    };
    const auto tool_button = [&](std::string label, MarkKind kind) {
        return button(tool == kind ? "[" + label + "]" : label, ChooseMarkTool{kind});
    };
    std::vector<xr::PanelRow> rows;
    rows.push_back(
        {"Draw",
         "",
         {tool_button("Stroke", MarkKind::stroke), tool_button("Arrow", MarkKind::arrow),
          tool_button("Pin", MarkKind::pin), tool_button("Distance", MarkKind::distance)}});
    std::vector<xr::PanelButton> buttons{
        button("Undo", ChangeMarks{undo_mark}),
        button("Clear mine",
               ChangeMarks{[](client::Participant& p) { return clear_marks(p, false); }})};
    if (is_operator)
        buttons.push_back(button(
            "Clear all", ChangeMarks{[](client::Participant& p) { return clear_marks(p, true); }}));
    rows.push_back({"Remove", "", std::move(buttons)});
    panel.panels.push_back({"Marks", std::move(rows)});
}

}  // namespace theatron::viewer
