// SPDX-License-Identifier: Apache-2.0
// The panels of a window with a bar of buttons: one at a time, always at the same place.
#pragma once

namespace theatron::viewer {

enum class Sheet {
    none,
    people,
    patient_case,
    draw,
    adjust,   // the cameras
    more,     // what has no button of its own: opens the following ones
    details,  // of the cameras
    sound,
    places,
    screens,
    look_back,
    chat,
    study,  // beside the others in a window; a plate of a headset
};

}  // namespace theatron::viewer
