// SPDX-License-Identifier: Apache-2.0
#include "viewer/mark_panel.h"

#include <utility>

#include "phrases/phrase.h"
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
    rows.push_back({say(Phrase::draw),
                    "",
                    {tool_button(say(Phrase::stroke), MarkKind::stroke),
                     tool_button(say(Phrase::arrow), MarkKind::arrow),
                     tool_button(say(Phrase::pin), MarkKind::pin),
                     tool_button(say(Phrase::distance), MarkKind::distance)}});
    std::vector<xr::PanelButton> buttons{
        button(say(Phrase::undo), ChangeMarks{undo_mark}),
        button(say(Phrase::clear_mine),
               ChangeMarks{[](client::Participant& p) { return clear_marks(p, false); }})};
    if (is_operator)
        buttons.push_back(button(say(Phrase::clear_all), ChangeMarks{[](client::Participant& p) {
                                     return clear_marks(p, true);
                                 }}));
    rows.push_back({say(Phrase::remove), "", std::move(buttons)});
    panel.panels.push_back({say(Phrase::marks), std::move(rows)});
}

}  // namespace theatron::viewer
