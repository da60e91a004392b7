// SPDX-License-Identifier: Apache-2.0
#include "window/keyboard_focus.h"

#include <algorithm>

namespace theatron::window {
namespace {

// The step of a key; the arrows and Esc are the room's while no control has the keyboard.
std::optional<FocusStep> step_of(const KeyPress& key, bool has_focus) {
    switch (key.action) {
        case Action::next_control:
            return FocusStep::next;
        case Action::previous_control:
            return FocusStep::previous;
        case Action::leave:
            return has_focus ? std::optional(FocusStep::none) : std::nullopt;
        case Action::nudge:
            if (!has_focus)
                return std::nullopt;
            return key.nudge == Nudge::left || key.nudge == Nudge::farther ? FocusStep::left
                                                                           : FocusStep::right;
        default:
            return std::nullopt;
    }
}

}  // namespace

std::optional<std::size_t> moved_focus(std::optional<std::size_t> focus, FocusStep step,
                                       std::size_t controls, std::size_t begin) {
    if (controls == 0 || step == FocusStep::none)
        return std::nullopt;
    const std::size_t last = controls - 1;
    // Controls may have gone since the last key.
    if (focus)
        focus = std::min(*focus, last);
    switch (step) {
        case FocusStep::next:
            return !focus ? std::min(begin, last) : *focus == last ? 0 : *focus + 1;
        case FocusStep::previous:
            return !focus || *focus == 0 ? last : *focus - 1;
        case FocusStep::left:
            return focus && *focus > 0 ? *focus - 1 : focus;
        case FocusStep::right:
            return focus ? std::min(*focus + 1, last) : focus;
        case FocusStep::none:
            break;
    }
    return std::nullopt;
}

std::optional<std::size_t> take_focus_keys(WindowInput& input, std::size_t controls,
                                           std::size_t begin, std::optional<std::size_t>& focus) {
    std::optional<std::size_t> pressed;
    std::erase_if(input.keys, [&](const KeyPress& key) {
        if (const auto step = step_of(key, focus.has_value())) {
            focus = moved_focus(focus, *step, controls, begin);
            return true;
        }
        // The space key freezes the picture where no button has the keyboard.
        const bool presses = key.action == Action::press_control || key.action == Action::freeze;
        if (focus && presses && *focus < controls)
            pressed = focus;
        return focus && presses;
    });
    // The key that presses buttons is that of push to talk.
    input.talks = input.talks && !focus;
    return pressed;
}

}  // namespace theatron::window
