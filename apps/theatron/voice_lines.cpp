// SPDX-License-Identifier: Apache-2.0
#include "voice_lines.h"

#include <sstream>

#include "base/log.h"
#include "phrases/phrase.h"

namespace theatron::app {

bool obey_voice_line(VoiceLine& voice, const std::string& line) {
    std::istringstream words(line);
    std::string what, value;
    words >> what >> value;
    if (what == "talk" && (value == "on" || value == "off")) {
        voice.hold_by_line(value == "on");
        return true;
    }
    if (what == "use" && (value == "microphone" || value == "speaker")) {
        std::string name;
        std::getline(words >> std::ws, name);
        if (name.empty())
            name = "default";
        if (value == "speaker")
            voice.use_speaker(name);
        else
            voice.use_microphone(name);
        return true;
    }
    if (what != "microphone" || (value != "on" && value != "off" && value != "push"))
        return false;
    if (!voice.has_microphone())
        log::say(say(Phrase::no_microphone_here));
    if (value == "off")
        voice.close_microphone();
    else
        voice.open_microphone(value == "push");
    return true;
}

}  // namespace theatron::app
