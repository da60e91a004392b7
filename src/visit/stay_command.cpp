// SPDX-License-Identifier: Apache-2.0
#include "visit/stay_command.h"

#include <sstream>

namespace theatron::visit {
namespace {

std::optional<bool> on_or_off(const std::string& word) {
    if (word == "on" || word == "off")
        return word == "on";
    return std::nullopt;
}

}  // namespace

std::optional<StayCommand> stay_command(const std::string& line) {
    std::istringstream words(line);
    std::string what, value, rest;
    words >> what >> value;
    std::getline(words >> std::ws, rest);
    if (what == "use") {
        const std::string device = rest.empty() ? "default" : rest;
        if (value == "microphone")
            return UseMicrophone{device};
        if (value == "speaker")
            return UseSpeaker{device};
        return std::nullopt;
    }
    if (!rest.empty())
        return std::nullopt;
    if (what == "microphone" && value == "push")
        return SetMicrophone{SetMicrophone::To::push_to_talk};
    const std::optional<bool> is_on = on_or_off(value);
    if (!is_on)
        return std::nullopt;
    if (what == "microphone")
        return SetMicrophone{*is_on ? SetMicrophone::To::open : SetMicrophone::To::closed};
    if (what == "talk")
        return HoldTalk{*is_on};
    if (what == "voice-recording")
        return AllowVoiceRecording{is_on};
    if (what == "webcam")
        return ShowFace{is_on};
    if (what == "face")
        return ShowExpression{*is_on};
    return std::nullopt;
}

std::optional<StayCommand> stay_command(window::Action action) {
    switch (action) {
        case window::Action::microphone:
            return ToggleMicrophone{};
        case window::Action::push_to_talk:
            return TogglePushToTalk{};
        case window::Action::voice_recording:
            return AllowVoiceRecording{};
        case window::Action::own_face:
            return ShowFace{};
        default:
            return std::nullopt;
    }
}

StayCommand stay_command(const viewer::UseSound& choice) {
    if (choice.kind == viewer::UseSound::Kind::microphone)
        return UseMicrophone{choice.device};
    return UseSpeaker{choice.device};
}

}  // namespace theatron::visit
