// SPDX-License-Identifier: Apache-2.0
// Changes that a person makes to voice, face and devices while they are in a session. One type for
// lines of a terminal, keys and buttons of a window, and its panels.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "viewer/room_panel.h"
#include "window/window_input.h"

namespace theatron::visit {

// Closes an open microphone, and opens a closed one. A person who came without a microphone gets
// that of their settings.
struct ToggleMicrophone {
    bool operator==(const ToggleMicrophone&) const = default;
};
// Opens or closes the microphone that the person came with.
struct SetMicrophone {
    enum class To { closed, open, push_to_talk } to{};
    bool operator==(const SetMicrophone&) const = default;
};
struct TogglePushToTalk {
    bool operator==(const TogglePushToTalk&) const = default;
};
// A line holds push to talk until another line lets it go.
struct HoldTalk {
    bool held = false;
    bool operator==(const HoldTalk&) const = default;
};
// The names are those of sound::open_microphone() and open_speaker().
struct UseMicrophone {
    std::string device;
    bool operator==(const UseMicrophone&) const = default;
};
struct UseSpeaker {
    std::string device;
    bool operator==(const UseSpeaker&) const = default;
};
// Nullopt turns the present choice round.
struct AllowVoiceRecording {
    std::optional<bool> agrees;
    bool operator==(const AllowVoiceRecording&) const = default;
};
struct ShowFace {
    std::optional<bool> shown;
    bool operator==(const ShowFace&) const = default;
};
// The expression that a tracker sees; see FaceLine.
struct ShowExpression {
    bool shown = false;
    bool operator==(const ShowExpression&) const = default;
};

using StayCommand =
    std::variant<ToggleMicrophone, SetMicrophone, TogglePushToTalk, HoldTalk, UseMicrophone,
                 UseSpeaker, AllowVoiceRecording, ShowFace, ShowExpression>;

// The command of a line such as "microphone off", "talk on", "use speaker NAME", "voice-recording
// on", "webcam off" or "face on"; nullopt: it is another line. Safe for any text.
std::optional<StayCommand> stay_command(const std::string& line);
// The command of a key, or of a button that is worth a key; nullopt: it is another one.
std::optional<StayCommand> stay_command(window::Action action);
// The command of a choice in the panel of devices.
StayCommand stay_command(const viewer::UseSound& choice);

}  // namespace theatron::visit
