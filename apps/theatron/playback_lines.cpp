// SPDX-License-Identifier: Apache-2.0
#include "playback_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <sstream>

#include "base/error.h"
#include "base/log.h"
#include "viewer/playing.h"
#include "wire/manage_text.h"

namespace theatron::app {
namespace {

// Longer than any recording; a larger number would not fit into the message.
constexpr double most_seconds = 1e9;

template <class Target, class Carry>
bool obey(const std::string& line, const Target& target, TimePoint now, const Carry& carry_out) {
    try {
        const auto playback = target.playback();
        const auto wish =
            parse_playback_line(line, playback ? viewer::position_at(*playback, now) : Duration(0));
        if (wish && !playback)
            throw Error(wire::text_of(wire::ManageRefusal::nothing_to_play));
        if (wish)
            carry_out(*wish);
        return wish.has_value();
    } catch (const Error& error) {
        log::say(error.what());
        return true;
    }
}

}  // namespace

const char* playback_lines_help() {
    return "'pause', 'play', 'seek SECONDS', 'seek +SECONDS', 'seek -SECONDS'";
}

std::optional<PlaybackLine> parse_playback_line(const std::string& line, Duration here) {
    std::istringstream words(line);
    std::string what, value, more;
    words >> what >> value >> more;
    if (what == "pause" || what == "play") {
        if (!value.empty())
            throw Error("Say '" + what + "' alone.");
        return PlaybackLine{what == "pause" ? wire::PlayAction::pause : wire::PlayAction::resume,
                            {}};
    }
    if (what != "seek")
        return std::nullopt;
    double seconds = 0;
    std::size_t used = 0;
    try {
        seconds = std::stod(value, &used);
    } catch (const std::exception&) {
        used = 0;
    }
    if (used == 0 || used != value.size() || !more.empty() || !(std::abs(seconds) <= most_seconds))
        throw Error("Say 'seek SECONDS', or 'seek +5' and 'seek -5' from here on.");
    const bool is_relative = value[0] == '+' || value[0] == '-';
    const Duration to = seconds_to_duration(seconds) + (is_relative ? here : Duration(0));
    return PlaybackLine{wire::PlayAction::seek, std::max(to, Duration(0))};
}

bool obey_playback_line(client::Participant& participant, const std::string& line) {
    return obey(line, participant, participant.now(), [&](const PlaybackLine& wish) {
        if (participant.play(wish.action, wish.position) == 0)
            throw Error("You have not joined yet.");
    });
}

const char* look_back_help() {
    return "'back SECONDS', 'live'";
}

bool obey_look_back_line(client::Participant& participant, const std::string& line) {
    std::istringstream words(line);
    std::string what, value, more;
    words >> what >> value >> more;
    if (what != "back" && what != "live")
        return false;
    double seconds = 0;
    int used = 0;
    const bool is_number = std::sscanf(value.c_str(), "%lf%n", &seconds, &used) == 1 &&
                           std::size_t(used) == value.size() && seconds >= 0 &&
                           seconds <= most_seconds;
    if (!more.empty() || (what == "live" ? !value.empty() : !is_number))
        log::say("Say 'back SECONDS', such as 'back 20', or 'live'.");
    else if (participant.look_back(seconds_to_duration(seconds)) == 0)
        log::say(participant.can_look_back() ? "You have not joined yet."
                                             : wire::text_of(wire::ManageRefusal::nothing_kept));
    return true;
}

bool refuse_looking_back(const client::Participant& participant, const std::string& line) {
    constexpr const char* changing[] = {"case",   "mark", "nudge", "crop",  "point",
                                        "brick",  "grab", "move",  "width", "give",
                                        "remove", "pin",  "unpin", "end"};
    std::istringstream words(line);
    std::string what;
    words >> what;
    if (!participant.looks_back() ||
        std::find(std::begin(changing), std::end(changing), what) == std::end(changing))
        return false;
    log::say("'" + line.substr(0, 80) +
             "': You look back and change nothing meanwhile; say 'live' to come back to now.");
    return true;
}

bool obey_playback_line(host::Host& host, const std::string& line) {
    return obey(line, host, TimePoint{},
                [&](const PlaybackLine& wish) { host.play(wish.action, wish.position); });
}

}  // namespace theatron::app
