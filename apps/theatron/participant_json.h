// SPDX-License-Identifier: Apache-2.0
// A participant's figures for scripts and in a line for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "client/participant.h"

namespace theatron::app {

// {"host","cameras":[{"name","state","fps","mbit_per_s","age_ms":{…},"dropped","depth_codec",
// "color_codec",…}],"fps","mbit_per_s","age_ms":{"p50","p99","max"},"dropped","codec",
// "level","levels","sent","level_reason",…}
nlohmann::json participant_json(const client::Participant& participant);

// The same in one line.
std::string status_line(const client::Participant& participant);

}  // namespace theatron::app
