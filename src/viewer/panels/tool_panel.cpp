// SPDX-License-Identifier: Apache-2.0
#include "viewer/panels/tool_panel.h"

#include <utility>

#include "phrases/phrase.h"
#include "viewer/tools/mark_actions.h"

namespace theatron::viewer {

void add_tool_panel(const ToolPanelFacts& facts, RoomPanel& panel) {
    const auto button = [&](Phrase label, RoomCommand command) {
        return panel.button(say(label), std::move(command));
    };
    std::vector<window::PanelRow> rows;
    const auto add_tools = [&](std::string name, const std::vector<ToolRow::Choice>& choices) {
        window::PanelRow row{std::move(name), "", {}};
        for (const auto& [kind, label] : choices) {
            row.buttons.push_back(button(label, ChooseTool{kind}));
            if (kind == facts.chosen)
                row.buttons.back().label = "[" + row.buttons.back().label + "]";
        }
        rows.push_back(std::move(row));
    };
    if (facts.has_hands)
        add_tools(say(Phrase::hand), {{ToolKind::none, Phrase::hold}});
    for (const ToolRow& row : tool_rows())
        if (!row.needs_case)
            add_tools(say(row.name), row.choices);
    std::vector<window::PanelButton> buttons{
        button(Phrase::undo, ChangeMarks{undo_mark}),
        button(Phrase::clear_mine,
               ChangeMarks{[](client::Participant& p) { return clear_marks(p, false); }})};
    if (facts.is_operator)
        buttons.push_back(button(Phrase::clear_all, ChangeMarks{[](client::Participant& p) {
                                     return clear_marks(p, true);
                                 }}));
    rows.push_back({say(Phrase::remove_marks), "", std::move(buttons)});
    // Below: the rows above keep their places when a case is opened.
    for (const ToolRow& row : tool_rows())
        if (row.needs_case && facts.has_case)
            add_tools(say(row.name), row.choices);
    panel.panels.push_back({say(Phrase::marks), std::move(rows)});
}

}  // namespace theatron::viewer
