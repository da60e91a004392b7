// SPDX-License-Identifier: Apache-2.0
// The form of the log's lines: text for people, or JSON for programs that read a journal.
#pragma once

#include <string>
#include <string_view>

namespace theatron::log {

// True: from now on each line is a JSON object:
// {"time":"2026-11-22T07:31:41.250Z","level":"info","area":"net","event":"participant joined",
//  "fields":{"id":"3"},"session":"OR 4"}
// A sentence of say() is an event without area and fields. Values are strings. From any thread.
void set_json_lines(bool on);

// A sentence in the form that is chosen, with its line feed. A very long one is cut.
std::string sentence_line(std::string_view sentence);

}  // namespace theatron::log
