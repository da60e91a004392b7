// SPDX-License-Identifier: Apache-2.0
// The presses of keys and buttons since the last picture, in their order, one input after the
// other: a slow picture makes none of them unseen.
//
// Pure. Not thread safe.
#pragma once

#include <cstddef>
#include <deque>

#include "window/window_input.h"

namespace theatron::window {

class InputQueue {
public:
    // Inputs that wait, and keys of one input. Further presses are left out; a release never is.
    static constexpr std::size_t max_waiting = 64;

    void press(const KeyPress& key);
    void type(const FormKeyPress& key);
    void grab(Vec2 place, bool left);
    void release();
    // The pointer is there from now on, and was where it was until then when a button was released.
    void move(Vec2 place);
    // For all that adds up or is a state: movements, the pointer, keys that are held.
    WindowInput& newest() { return waiting_.back(); }

    // The oldest input: keys, or one press of a button, or its release. Without any only the
    // states.
    WindowInput take();
    // Something has come that was not taken yet.
    bool has_more() const;

private:
    bool begin_next();

    std::deque<WindowInput> waiting_{1};
};

}  // namespace theatron::window
