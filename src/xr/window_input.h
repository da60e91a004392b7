// SPDX-License-Identifier: Apache-2.0
// A person's input at the window, in plain values: no type of the window system.
#pragma once

#include <optional>
#include <vector>

#include "xr/navigation.h"

namespace theatron::xr {

// The command of a key, given at the moment it is pressed. Keys for flying act as long as
// they are down: they are part of Steering.
enum class Action {
    leave,
    help,
    facts,
    full_screen,
    next_renderer,
    next_depth_codec,
    next_color_codec,
    new_brick,  // creates a shared object
    give,       // gives the held object to the nearest person
    remove,     // removes the held object
    sit_or_stand,
    microphone,   // closes or opens it
    people,       // shows or hides the panel of people and places
    show_case,    // shows or hides the panel of the case
    marks,        // begins or ends marking, and shows or hides its panel
    undo_mark,    // removes this person's newest mark
    slice_here,   // moves the slice to the place of an organ under the mouse
    admit,        // for operators: lets in the person who has waited longest
    turn_away,    // the opposite
    call,         // asks the others to come, or no longer does
    come,         // goes to the person who asks for that
    own_view,     // back to the camera's own view
    view_camera,  // `camera` of the key press
};

struct KeyPress {
    Action action{};
    int camera = 0;  // counted from 0
};

struct WindowInput {
    bool close = false;   // the window's own button, or the system asks the program to end
    bool redraw = false;  // the window was uncovered or has another size
    std::vector<KeyPress> keys;
    // The place where a turn or a slide began, if one did: shares of the window's width and
    // height from its top left corner.
    std::optional<Vec2> grabbed;
    bool grabbed_left = false;  // it began with the left button
    bool released = false;      // the left button
    // The mouse, in the same shares, if it is in the window; and whether the key for teleports is
    // down.
    std::optional<Vec2> pointer;
    bool aims_teleport = false;
    bool points = false;  // the key for pointing is down
    Steering steering;
};

// The keys as the help shows them.
struct KeyHelp {
    const char* keys;
    const char* meaning;
};
const std::vector<KeyHelp>& key_help();

}  // namespace theatron::xr
