// SPDX-License-Identifier: Apache-2.0
// Lines of `theatron join` on marks, for scripts and tests.
#pragma once

#include <string>

#include "client/participant.h"

namespace theatron::app {

const char* mark_lines_help();

// Carries out a line that begins with "mark". False if it is none. A sentence on a wrong line is
// printed.
bool obey_mark_line(client::Participant& participant, const std::string& line);

}  // namespace theatron::app
