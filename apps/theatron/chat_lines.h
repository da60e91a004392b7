// SPDX-License-Identifier: Apache-2.0
// Lines of standard input of `theatron join` that write to all others or raise a hand, and the
// messages as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "client/participant.h"

namespace theatron::app {

const char* chat_lines_help();

// Carries out "chat TEXT", "hand up" or "hand down"; false if the line is none of them. A sentence
// on a line that cannot be carried out is printed.
bool obey_chat_line(client::Participant& participant, const std::string& line);

// {"may_write":, "messages": [{"from":, "name":, "text":, "session_us":}], "unsent": []}
nlohmann::json chat_json(const client::Participant& participant);

}  // namespace theatron::app
