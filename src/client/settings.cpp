// SPDX-License-Identifier: Apache-2.0
#include "client/settings.h"

#include <sstream>

#include "base/error.h"
#include "base/outside_text.h"
#include "files/private_file.h"
#include "wire/control.h"

namespace theatron::client {
namespace {

constexpr const char* file_name = "settings";
constexpr std::size_t max_device_name = 256;

const char* text_of(bool value) {
    return value ? "yes" : "no";
}

bool read(const std::string& text, bool& value) {
    value = text == "yes";
    return value || text == "no";
}

bool read_text(const std::string& text, std::string& value) {
    if (text.empty() || clean_text(text, wire::max_name) != text)
        return false;
    value = text;
    return true;
}

// A name that a line cannot hold is left out.
std::string device_line(const char* kind, const std::string& device) {
    return device.empty() || clean_text(device, max_device_name) != device
               ? ""
               : std::string("\n") + kind + " " + device;
}

bool read_device(const std::string& text, std::string& device) {
    if (text.empty() || clean_text(text, max_device_name) != text)
        return false;
    device = text;
    return true;
}

bool read_quality(const std::string& text, std::string& value) {
    value = text;
    return text == "auto" || text == "low" || text == "high";
}

}  // namespace

std::string settings_text(const Settings& settings) {
    const std::string name = clean_text(settings.name, wire::max_name);
    return (name.empty() ? "" : "name " + name + "\n") + "renderer " + settings.renderer +
           "\nsits " + text_of(settings.sits) + "\npeople " + text_of(settings.shows_people) +
           "\ndetails " + text_of(settings.shows_facts) + "\nhears " + text_of(settings.hears) +
           "\nspeaks " + text_of(settings.speaks) + "\npush_to_talk " +
           text_of(settings.push_to_talk) + "\nvoice_recorded " +
           text_of(settings.voice_may_record) + "\ntour_seen " + text_of(settings.tour_seen) +
           device_line("microphone", settings.microphone) +
           device_line("loudspeaker", settings.loudspeaker) + "\nquality " + settings.quality +
           "\n";
}

ParsedSettings parse_settings(const std::string& text) {
    ParsedSettings parsed;
    Settings& settings = parsed.settings;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const auto space = line.find(' ');
        const std::string name = line.substr(0, space);
        const std::string value = space == std::string::npos ? "" : line.substr(space + 1);
        const bool is_right = name == "name"             ? read_text(value, settings.name)
                              : name == "renderer"       ? read_text(value, settings.renderer)
                              : name == "sits"           ? read(value, settings.sits)
                              : name == "people"         ? read(value, settings.shows_people)
                              : name == "details"        ? read(value, settings.shows_facts)
                              : name == "hears"          ? read(value, settings.hears)
                              : name == "speaks"         ? read(value, settings.speaks)
                              : name == "push_to_talk"   ? read(value, settings.push_to_talk)
                              : name == "voice_recorded" ? read(value, settings.voice_may_record)
                              : name == "tour_seen"      ? read(value, settings.tour_seen)
                              : name == "microphone"     ? read_device(value, settings.microphone)
                              : name == "loudspeaker"    ? read_device(value, settings.loudspeaker)
                              : name == "quality"        ? read_quality(value, settings.quality)
                                                         : clean_text(name, 100) == name;
        if (!is_right)
            return {{}, "the line '" + clean_text(line, 100) + "' is not understood"};
    }
    return parsed;
}

Settings load_settings(const std::filesystem::path& folder, std::string& problem) {
    problem.clear();
    if (folder.empty())
        return {};
    try {
        const auto text = files::read_private_file(folder / file_name, files::Privacy::readable);
        const ParsedSettings parsed = parse_settings(text.value_or(""));
        if (!parsed.problem.empty())
            problem = "The usual settings are used, since in '" + (folder / file_name).string() +
                      "' " + parsed.problem + ".";
        return parsed.settings;
    } catch (const Error& error) {
        problem = std::string("The usual settings are used. ") + error.what();
        return {};
    }
}

std::string save_settings(const std::filesystem::path& folder, const Settings& settings) {
    if (folder.empty())
        return "";
    try {
        files::open_private_folder(folder);
        files::write_private_file(folder / file_name, settings_text(settings));
        return "";
    } catch (const Error& error) {
        return std::string("The settings are not kept. ") + error.what();
    }
}

}  // namespace theatron::client
