// SPDX-License-Identifier: Apache-2.0
// Lines of standard input of `theatron join` for the participant of a study, and its step as JSON:
// for scripts.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "client/participant.h"

namespace theatron::app {

const char* study_lines_help();

// Carries out "study reply VALUE", "study done", "study skip" or "study stop"; false if the line is
// none of them. A sentence on a wrong line is printed.
bool obey_study_line(client::Participant& participant, const std::string& line);

// The step that the participant is to see; null: none.
nlohmann::json study_json(const client::Participant& participant);

// Prints each new step as a line of JSON: {"study": ...}.
class StudyLines {
public:
    void on_tick(const client::Participant& participant);

private:
    std::uint64_t version_ = 0;
};

}  // namespace theatron::app
