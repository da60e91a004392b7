// SPDX-License-Identifier: Apache-2.0
// The output of log lines: standard error, by a thread of its own if there are threads.
#pragma once

#include <string>

namespace theatron::log {

// `line` ends in a line feed and is written whole or left out. From any thread.
void output_line(std::string line);

}  // namespace theatron::log
