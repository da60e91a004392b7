// SPDX-License-Identifier: Apache-2.0
// The panel of microphones and loudspeakers, with a button for each that is not in use.
#pragma once

#include <string>
#include <vector>

#include "viewer/room_panel.h"

namespace theatron::viewer {

// Names as sound::open_microphone() takes them.
struct SoundChoices {
    std::vector<std::string> microphones, loudspeakers;  // that can be chosen
    std::string microphone, loudspeaker;                 // in use, or waited for; empty: none

    bool operator==(const SoundChoices&) const = default;
};

// A list without anything to choose is left out.
void add_sound_panel(const SoundChoices& choices, RoomPanel& panel);

}  // namespace theatron::viewer
