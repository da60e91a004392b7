// SPDX-License-Identifier: Apache-2.0
// Lines of standard input that play the recording which a host shows to all: of `theatron join`
// and of `theatron host`; and that look back at the last minute of a session.
#pragma once

#include <optional>
#include <string>

#include "client/participant.h"
#include "host/host.h"

namespace theatron::app {

const char* playback_lines_help();

struct PlaybackLine {
    wire::PlayAction action{};
    Duration position{};
};
// Reads "pause", "play", "seek SECONDS", or "seek +SECONDS" and "seek -SECONDS" from `here` on.
// nullopt if it is none of these. Throws Error with one sentence if it is wrong.
std::optional<PlaybackLine> parse_playback_line(const std::string& line, Duration here);

// Carries out such a line; false if it is none. A sentence on a wrong line is printed.
bool obey_playback_line(client::Participant& participant, const std::string& line);
// The same for "back SECONDS" and "live", with which this person alone looks back.
const char* look_back_help();
bool obey_look_back_line(client::Participant& participant, const std::string& line);
// True if this participant looks back, and the line would change the room, its case or a camera,
// which it sees as they were. A sentence says how to come back.
bool refuse_looking_back(const client::Participant& participant, const std::string& line);
bool obey_playback_line(host::Host& host, const std::string& line);

}  // namespace theatron::app
