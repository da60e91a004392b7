// SPDX-License-Identifier: Apache-2.0
#include "viewer/sound_panel.h"

#include <algorithm>
#include <utility>

#include "base/outside_text.h"
#include "phrases/phrase.h"

namespace theatron::viewer {
namespace {

// Characters of a device's name in a panel, and devices of a kind.
constexpr std::size_t max_shown_name = 40, max_shown_devices = 12;

std::string shown_name(const std::string& device) {
    return device == "default" ? say(Phrase::usual_device) : clean_text(device, max_shown_name);
}

void add_kind(UseSound::Kind kind, const std::vector<std::string>& devices,
              const std::string& in_use, RoomPanel& panel, window::Panel& sound) {
    if (devices.empty() && in_use.empty())
        return;
    const Phrase title =
        kind == UseSound::Kind::microphone ? Phrase::microphone : Phrase::loudspeaker;
    sound.rows.push_back(
        {say(title), in_use.empty() ? say(Phrase::no_device) : shown_name(in_use), {}});
    std::size_t shown = 0;
    for (const std::string& device : devices) {
        if (device == in_use || shown++ == max_shown_devices)
            continue;
        sound.rows.push_back(
            {shown_name(device), "", {panel.button(say(Phrase::use), UseSound{kind, device})}});
    }
}

}  // namespace

void add_sound_panel(const SoundChoices& choices, RoomPanel& panel) {
    window::Panel sound{say(Phrase::sound), {}};
    add_kind(UseSound::Kind::microphone, choices.microphones, choices.microphone, panel, sound);
    add_kind(UseSound::Kind::loudspeaker, choices.loudspeakers, choices.loudspeaker, panel, sound);
    if (!sound.rows.empty())
        panel.panels.push_back(std::move(sound));
}

}  // namespace theatron::viewer
