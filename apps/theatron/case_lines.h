// SPDX-License-Identifier: Apache-2.0
// Lines of `theatron join` on the case that is open in the room, for scripts and tests.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "client/participant.h"

namespace theatron::app {

const char* case_lines_help();

// Carries out a line that begins with "case". False if it is none. A sentence on a wrong line is
// printed.
bool obey_case_line(client::Participant& participant, const std::string& line);

// {"offered":[names],"open":{"name","hash","complete","got","all","problem","parts":[{"object",
// "name","shown","opacity","is_here"}],"pictures","screen"}}; "open" is null without a case.
nlohmann::json case_json(const client::Participant& participant);

}  // namespace theatron::app
