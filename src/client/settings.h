// SPDX-License-Identifier: Apache-2.0
// A person's own settings, with which the next window begins: `settings` in the person's state
// folder. Neither links nor tokens are among them.
#pragma once

#include <filesystem>
#include <string>

namespace theatron::client {

struct Settings {
    std::string name = "guest";
    std::string renderer = "auto";
    bool sits = false;                    // the eyes' height after a teleport
    bool shows_people = false;            // the panel of people and places
    bool shows_facts = false;             // the details of picture and connection
    std::string quality = "auto";         // of the virtual room: auto, low or high
    bool hears = false;                   // the others' voices, where no command line says more
    bool speaks = false;                  // to the others, where no command line says more
    std::string microphone = "default";   // as in sound::open_microphone()
    std::string loudspeaker = "default";  // as in sound::open_speaker()
    bool push_to_talk = false;            // the microphone is open only while a key is held
    bool voice_may_record = false;        // the person agrees that others record the voice
    bool tour_seen = false;               // the tour of a first visit does not come by itself
    bool operator==(const Settings&) const = default;
};

// One line for each setting, its name and its value: "sits yes".
std::string settings_text(const Settings& settings);

struct ParsedSettings {
    Settings settings;    // all usual ones if there is a problem
    std::string problem;  // one clause; empty: none
};
// Settings that are missing keep their usual values; unknown ones, of a newer program, are ignored.
// Safe for any text.
ParsedSettings parse_settings(const std::string& text);

// The settings in this folder; the usual ones if there are none there, or the folder's name is
// empty. `problem` becomes one sentence if the file cannot be used, else empty.
Settings load_settings(const std::filesystem::path& folder, std::string& problem);
// Atomic. Returns one sentence about what is wrong; empty if nothing is.
std::string save_settings(const std::filesystem::path& folder, const Settings& settings);

}  // namespace theatron::client
