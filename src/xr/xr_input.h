// SPDX-License-Identifier: Apache-2.0
// Controllers and tracked hands of a headset as intents: take, let go, point, walk, turn, teleport,
// give, menu. The same for every runtime.
//
// A pure state machine; its input is a frame of the headset.
#pragma once

#include "xr/headset_frame.h"

namespace theatron::xr {

// A trigger, or a pinch of thumb and index finger, is a grip: both take what the ray meets.
struct HandIntents {
    bool is_present = false;
    bool is_bare = false;  // a tracked hand without a controller
    Pose floor_from_aim, floor_from_grip;
    bool takes = false;    // the grip has just closed
    bool holds = false;    // the grip is closed
    bool lets_go = false;  // the grip has just opened, or the hand was lost with a closed grip
    bool points = false;   // squeezed, or with the index finger alone
    bool aims_teleport = false, teleports = false;  // the stick is forward; it was let go
    double pushes_away = 0;                         // -1 to 1, of what it holds
    double turns_held = 0;                          // -1 to 1, to the left
    bool gives = false;                             // the button for that has just been pressed
};

struct Intents {
    std::array<HandIntents, 2> hands;  // by Side
    double turn_degrees = 0;           // to the left
    Vec2 walk;                         // -1 to 1: x right, y ahead
    bool menu = false;                 // the button for that has just been pressed
};

class XrInput {
public:
    static constexpr double snap_degrees = 30;

    // `is_holding`: the hands, by Side, that hold an object; their sticks move it.
    Intents update(const HeadsetFrame& frame, std::array<bool, 2> is_holding);

private:
    struct Hand {
        bool grips = false, aims = false, snapped = false;
        bool lower_button = false, upper_button = false;
    };
    std::array<Hand, 2> hands_;
};

}  // namespace theatron::xr
