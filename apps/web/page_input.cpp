// SPDX-License-Identifier: Apache-2.0
#include "page_input.h"

#include <map>

namespace theatron::web {

std::optional<window::KeyPress> pressed(std::string_view key, std::string_view code) {
    using window::Action;
    // Digits by their place: some keyboards need Shift for them. Tab and Escape stay the browser's,
    // and the page itself shows the help.
    for (const std::string_view row : {"Digit", "Numpad"})
        if (code.size() == row.size() + 1 && code.substr(0, row.size()) == row &&
            code.back() >= '1' && code.back() <= '9')
            return window::KeyPress{Action::view_camera, code.back() - '1'};
    if (code == "Digit0")
        return window::KeyPress{Action::from_above};
    // On AZERTY keyboards, the place of W has the letter Z and walks; that of Z has the letter W.
    if (code == "KeyW" && key == "z")
        return std::nullopt;
    if (code == "KeyZ" && key == "w")
        return window::KeyPress{Action::marks};
    static const std::map<std::string_view, Action> actions = {
        {"b", Action::facts},
        {"m", Action::next_renderer},
        {"c", Action::next_depth_codec},
        {"v", Action::next_color_codec},
        {"n", Action::new_brick},
        {"g", Action::give},
        {"y", Action::admit},
        {"k", Action::call},
        {"j", Action::come},
        {"u", Action::turn_away},
        {"delete", Action::remove},
        {"x", Action::sit_or_stand},
        {"p", Action::people},
        {"o", Action::show_case},
        {"i", Action::slice_here},
        {"r", Action::own_view},
        {"home", Action::own_view},
        {"z", Action::marks},
        {"backspace", Action::undo_mark},
        {"escape", Action::leave},  // what is being drawn
        {"0", Action::from_above},
        {"+", Action::larger_points},
        {"=", Action::larger_points},
        {"-", Action::smaller_points},
        {" ", Action::freeze},
        {",", Action::seek_back},
        {".", Action::seek_forward},
        {";", Action::seek_forward},  // beside the comma where the full stop needs Shift
        {"end", Action::live},
    };
    const auto found = actions.find(key);
    if (found == actions.end())
        return std::nullopt;
    return window::KeyPress{found->second};
}

}  // namespace theatron::web
