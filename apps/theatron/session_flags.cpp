// SPDX-License-Identifier: Apache-2.0
#include "session_flags.h"

#include <sstream>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/outside_text.h"
#include "cli/camera_option.h"
#include "cli/choice_check.h"
#include "cli/number_check.h"
#include "cli/seconds_option.h"
#include "host/session_folder.h"
#include "session/permissions.h"

namespace theatron::app {
namespace {

namespace fs = std::filesystem;

bool is_option(const std::string& word, const std::string& option) {
    return word == option || word.starts_with(option + "=");
}

bool begins_session(const std::string& word) {
    return is_option(word, "--session") || is_option(word, "--name");
}

// "operator,expert", or "nobody".
std::vector<wire::Role> parse_patient_roles(const std::string& text) {
    std::vector<wire::Role> roles;
    if (text == "nobody")
        return roles;
    std::istringstream words(text);
    for (std::string word; std::getline(words, word, ',');) {
        const auto role = wire::parse_role(word);
        if (!role || !session::may_know_patient(*role))
            throw Error("'" + clean_text(word, 40) +
                        "' in --identifiers-for is none of operator, expert and publisher" +
                        (role ? ": observers never learn who the patient is." : ", or nobody."));
        roles.push_back(*role);
    }
    return roles;
}

std::string absolute_path(const std::string& path, const fs::path& folder) {
    return path.empty() ? path : (folder / path).lexically_normal().string();
}

// The source of a camera is a file in some kinds only: it is one where there is a file.
std::string absolute_camera(const std::string& specification, const fs::path& folder) {
    const std::size_t colon = specification.find(':');
    const std::size_t comma = specification.find(',');
    if (colon == std::string::npos || comma < colon)
        return specification;
    const std::string source = specification.substr(colon + 1, comma - colon - 1);
    std::error_code none;
    if (source.empty() || !fs::exists(folder / source, none))
        return specification;
    return specification.substr(0, colon + 1) + absolute_path(source, folder) +
           (comma == std::string::npos ? "" : specification.substr(comma));
}

// "FILTER" or "CAMERA=FILTER", where FILTER may be a file.
std::string absolute_filter(const std::string& text, const fs::path& folder) {
    const std::size_t equals = text.find('=');
    const std::size_t begin = equals == std::string::npos ? 0 : equals + 1;
    std::error_code none;
    for (const std::size_t at : {std::size_t(0), begin})
        if (fs::is_regular_file(folder / text.substr(at), none))
            return text.substr(0, at) + absolute_path(text.substr(at), folder);
    return text;
}

std::string number_text(double value) {
    std::ostringstream text;
    text.precision(17);
    text << value;
    return text.str();
}

}  // namespace

void add_session_options(CLI::App& command, SessionFlags& flags) {
    cli::add_camera_option(command, flags.options.cameras);
    command.add_option("--places", flags.places,
                       "Where the cameras are in the room: a file that 'theatron register' wrote. "
                       "A camera's own place=X:Y:Z:YAW:PITCH:ROLL is the last word");
    command
        .add_option("--region", flags.regions,
                    "CAMERA=X:Y:WIDTH:HEIGHT, the part of a camera's depth image that stays exact "
                    "when a slow link makes the rest coarser; a polygon is CAMERA=X:Y:X:Y:X:Y. "
                    "CAMERA is a number from 0 or a name. Repeat for more parts. Without a region "
                    "the whole image stays exact")
        ->allow_extra_args(false);
    command.add_option("--cases", flags.cases,
                       "A folder of cases (docs/cases.md): each case that lies there, or is put "
                       "there later, can be opened in the room");
    command.add_option("--recordings", flags.recordings,
                       "The folder of recordings that operators begin on their page "
                       "(docs/operators_page.md). Else: recordings in the state folder");
    command
        .add_option("--identifiers-for", flags.identifiers_for,
                    "The roles that see the name, date of birth and number of the open case's "
                    "patient: operator, expert and publisher, with commas, or nobody")
        ->capture_default_str();
    command
        .add_option(
            "--filter", flags.options.filters,
            "Filters of depth: off, paper, default, stereo (for cameras that have few distinct "
            "depths), a line of filters or a JSON file, which may change meanwhile; CAMERA=... for "
            "one camera, by number from 0 or name. At its end @cuda filters on an NVIDIA GPU and "
            "@auto on whichever is quicker, that or the processor: default@cuda")
        ->allow_extra_args(false);
    command
        .add_option(
            "--link-hours", flags.link_hours,
            "After this number of hours the links let nobody in; participants who are in stay. "
            "0: they always do")
        ->check(cli::number_check([](double hours) { return hours >= 0 && hours <= 1000; },
                                  "is not a number of hours from 0 to 1000"));
    command
        .add_option("--admit", flags.admit,
                    "all: everyone with a valid link is let in; ask: experts and observers wait "
                    "until an operator admits them")
        ->capture_default_str()
        ->check(cli::one_of({"all", "ask"}));
    command
        .add_option("--look-back", flags.look_back_s,
                    "How many seconds participants may look back at the cameras of the room, 0 to "
                    "60; they are kept in memory only, 512 MiB at most. 0: nothing is kept")
        ->capture_default_str()
        ->check(cli::number_check(
            [](double seconds) {
                return seconds >= 0 && seconds <= to_seconds(session::Past::longest_reach);
            },
            "is not a number of seconds from 0 to 60"));
}

host::SessionOptions session_options(const SessionFlags& flags) {
    host::SessionOptions options = flags.options;
    options.places = flags.places;
    options.cases = flags.cases;
    options.recordings = flags.recordings;
    options.patient_for = parse_patient_roles(flags.identifiers_for);
    options.asks = flags.admit == "ask";
    options.link_lifetime = seconds_to_duration(flags.link_hours * 3600);
    options.look_back = seconds_to_duration(flags.look_back_s);
    return options;
}

std::vector<std::string> words_of(const SessionFlags& flags, const fs::path& folder) {
    std::vector<std::string> words;
    const auto add = [&](const char* option, const std::string& value) {
        words.emplace_back(option);
        words.push_back(value);
    };
    for (const std::string& camera : flags.options.cameras)
        add("--camera", absolute_camera(camera, folder));
    for (const std::string& region : flags.regions)
        add("--region", region);
    for (const std::string& filter : flags.options.filters)
        add("--filter", absolute_filter(filter, folder));
    if (!flags.places.empty())
        add("--places", absolute_path(flags.places, folder));
    if (!flags.cases.empty())
        add("--cases", absolute_path(flags.cases, folder));
    if (!flags.recordings.empty())
        add("--recordings", absolute_path(flags.recordings, folder));
    add("--identifiers-for", flags.identifiers_for);
    add("--admit", flags.admit);
    add("--link-hours", number_text(flags.link_hours));
    add("--look-back", number_text(flags.look_back_s));
    return words;
}

SessionFlags parse_session(const std::vector<std::string>& words) {
    SessionFlags flags;
    CLI::App session;
    session.set_help_flag();
    session.allow_extras();
    // First, since options are read in this order and a problem names the session.
    session.add_option("--session,--name", flags.options.name)->required();
    add_session_options(session, flags);
    std::vector<std::string> known = words;
    // Sessions that earlier versions kept have it; there is nothing left to say with it.
    if (const auto old = std::find(known.begin(), known.end(), "--direct"); old != known.end())
        known.erase(old, std::min(old + 2, known.end()));
    try {
        session.parse(std::vector<std::string>(known.rbegin(), known.rend()));
    } catch (const CLI::ParseError& error) {
        throw Error("Session '" + clean_text(flags.options.name, host::max_session_name) +
                    "': " + error.what() + ".");
    }
    if (const auto others = session.remaining(); !others.empty())
        throw Error("Session '" + clean_text(flags.options.name, host::max_session_name) + "': '" +
                    clean_text(others.front(), 80) +
                    "' is no option of a session; those of the host stand before its second "
                    "--session.");
    host::check_session_name(flags.options.name);
    return flags;
}

PartedWords part_sessions(const std::vector<std::string>& words) {
    PartedWords parted;
    std::size_t count = 0;
    for (const std::string& word : words) {
        if (begins_session(word) && ++count > 1)
            parted.further.emplace_back();
        (parted.further.empty() ? parted.first : parted.further.back()).push_back(word);
    }
    if (parted.further.empty())
        return parted;
    // Somebody who writes a camera before each name would show it to the people of another room.
    SessionFlags unused;
    CLI::App session;
    add_session_options(session, unused);
    for (const std::string& word : words) {
        if (begins_session(word))
            break;
        const std::string option = word.substr(0, word.find('='));
        if (option.starts_with("--") && option != "--help" && session.get_option_no_throw(option))
            throw Error("With several sessions the options of each stand behind its --session; " +
                        option + " stands before the first one.");
    }
    return parted;
}

}  // namespace theatron::app
