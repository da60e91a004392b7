// SPDX-License-Identifier: Apache-2.0
// The keyboard's way through the buttons of a window, which are numbered in the order in which they
// are read: Tab, the arrows, Return and Esc.
//
// Pure.
#pragma once

#include <cstddef>
#include <optional>

#include "window/window_input.h"

namespace theatron::window {

// The control that has the keyboard after a key: Tab goes round, first to `begin` (with Shift to
// the last); the arrows go on to the neighbour and stay at the ends. nullopt: none has it.
enum class FocusStep { next, previous, left, right, none };
std::optional<std::size_t> moved_focus(std::optional<std::size_t> focus, FocusStep step,
                                       std::size_t controls, std::size_t begin = 0);

// Takes the keys that `focus` uses out of `input`, and moves it. Returns the control that was
// pressed. There are `controls` of them, and the keyboard comes first to `begin`.
std::optional<std::size_t> take_focus_keys(WindowInput& input, std::size_t controls,
                                           std::size_t begin, std::optional<std::size_t>& focus);

}  // namespace theatron::window
