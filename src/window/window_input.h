// SPDX-License-Identifier: Apache-2.0
// A person's input at the window, in plain values: no type of the window system.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "phrases/language.h"
#include "window/form_input.h"
#include "window/navigation.h"

namespace theatron::window {

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
    microphone,       // closes or opens it
    push_to_talk,     // speak only while a key is held, or with an open microphone
    voice_recording,  // agrees that others record this person's voice, or no longer
    own_face,         // shows the others this person's webcam, or no longer
    people,           // shows or hides the panel of people and places
    show_case,        // shows or hides the panel of the case
    marks,            // begins or ends marking, and shows or hides its panel
    undo_mark,        // removes this person's newest mark
    slice_here,       // moves the slice to the place of an organ under the mouse
    admit,            // for operators: lets in the person who has waited longest
    turn_away,        // the opposite
    call,             // asks the others to come, or no longer does
    come,             // goes to the person who asks for that
    camera_pictures,  // shows or hides the plain pictures of the cameras
    from_above,       // to a place high above
    larger_points,
    smaller_points,
    pause_recording,  // that the host plays, for all; or goes on
    seek_back,        // in that; without one: this person alone looks back at the session
    seek_forward,
    live,            // ends looking back
    adjust_cameras,  // shows or hides the panel of cameras, for operators
    nudge,           // `nudge` of the key press: the chosen camera, while that panel is shown
    freeze,          // keeps the picture of the cameras, or no longer does
    save_picture,    // of what is seen, into a file
    save_points,     // of what the cameras see, into a file
    own_view,        // back to the camera's own view
    view_camera,     // `camera` of the key press
    point,           // begins or ends pointing with the mouse, without a key that is held
    leave_session,   // leaves it, also from full screen
    chat,            // shows or hides the panel of messages, and begins one
    raise_hand,      // or takes it down
    more,            // shows or hides the panel of all that has no button of its own
    next_control,    // the keyboard goes on to the next button
    previous_control,
    press_control,  // the button that has the keyboard
};

// A small step of a camera, in the room as the person sees it.
enum class Nudge { left, right, up, down, nearer, farther, turn_left, turn_right };

struct KeyPress {
    Action action{};
    int camera = 0;  // counted from 0
    Nudge nudge{};
};

struct WindowInput {
    bool close = false;   // the window's own button, or the system asks the program to end
    bool redraw = false;  // the window was uncovered or has another size
    std::vector<KeyPress> keys;
    std::vector<FormKeyPress> typed;  // in place of `keys`, while the window takes text
    // The place where a turn or a slide began, if one did: shares of the window's width and
    // height from its top left corner.
    std::optional<Vec2> grabbed;
    bool grabbed_left = false;  // it began with the left button
    bool released = false;      // the left button
    // The mouse, in the same shares, if it is in the window; and whether the key for teleports is
    // down.
    std::optional<Vec2> pointer;
    bool pointer_covered = false;  // by a panel
    bool aims_teleport = false;
    bool points = false;  // the key for pointing is down
    bool talks = false;   // the key of push to talk is down
    Steering steering;
};

// The keys as the help shows them.
struct KeyHelp {
    Sentence keys, meaning;
};
std::span<const KeyHelp> key_help();

}  // namespace theatron::window
