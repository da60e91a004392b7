// SPDX-License-Identifier: Apache-2.0
// A participant's figures for scripts and in a line for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "client/participant_figures.h"

namespace theatron::app {

// Milliseconds from capture to decoding, over the last minutes. While the past is shown: how long
// ago it was, in all three.
struct StreamAge {
    double p50 = 0, p99 = 0, max = 0;
};
StreamAge age_of(const receive::StreamFigures& stream);
// The age in status_line(), of the oldest stream: "age 38 ms", "NOT LIVE: 23 s ago".
std::string age_part(const client::ParticipantFigures& figures);

// How far apart the pictures of one moment were taken, and how many came without those of the other
// cameras: "cameras 15 ms apart (at most 18), 12 pictures alone"; empty: there is nothing to
// compare.
std::string moments_part(const MomentFigures& moments);

// {"host","cameras":[{"name","state","fps","mbit_per_s","age_ms":{…},"dropped","depth_codec",
// "color_codec",…}],"fps","mbit_per_s","age_ms":{"p50","p99","max"},"past","dropped",
// "skew_ms":{"p50","max"},"unpaired","codec","level","levels","sent","level_reason",…}
nlohmann::json participant_json(const client::Participant& participant);

// The same in one line.
std::string status_line(const client::Participant& participant);

}  // namespace theatron::app
