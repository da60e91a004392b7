// SPDX-License-Identifier: Apache-2.0
// A person's input into a form of fields and buttons, in plain values: no type of the window
// system.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/vec.h"

namespace theatron::window {

// The keys that edit a text or move between fields, and the letters that act with Ctrl.
enum class FormKey {
    tab,
    left,
    right,
    up,
    down,
    home,
    end,
    backspace,
    erase,  // the key Delete
    enter,
    space,
    escape,
    a,
    c,
    v,
    x,
    z,
    letters,  // `text` of the press was typed
};

struct FormKeyPress {
    FormKey key{};
    bool control = false, shift = false;
    std::string text = {};  // UTF-8
};

struct FormInput {
    bool close = false;              // as in WindowInput
    bool redraw = false;             // as in WindowInput
    std::vector<FormKeyPress> keys;  // with the letters in between, in their order
    // The mouse in shares of the window's width and height from its top left corner, if it is in
    // the window.
    std::optional<Vec2> pointer;
    bool is_down = false;  // the left button, now
    bool clicked = false;  // it was pressed since the last input, and may be up again
    double wheel = 0;      // clicks away from the user

    bool is_empty() const { return !close && !redraw && keys.empty() && !clicked && wheel == 0; }
};

}  // namespace theatron::window
