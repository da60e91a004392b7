// SPDX-License-Identifier: Apache-2.0
// Standard output of a program that receives or decides while it writes: threads of its own write,
// as for the log, so that a terminal, pipe or disk that takes nothing costs lines and nothing else.
// From any thread; never blocks. Not in the web build.
#pragma once

#include <string>

namespace theatron::output {

enum class Stream { output, error };

// Whole lines as they are: what others wrote in them is clean. They are left out, and counted in
// the log, while too many wait.
void print(std::string lines, Stream stream = Stream::output);

// The same for a line that a script waits for: it is not left out, however much waits.
void result(std::string line);

// On a terminal, a line below all others that the next one replaces. One that would have to wait is
// left out: a newer one follows.
void status_line(const std::string& text, Stream stream = Stream::output);
// Nothing replaces the last one any more.
void end_status_line();

// Nothing waits to be written, to standard output or standard error.
bool is_written();
// A result still waits, or could not be written.
bool has_results();
bool has_lost_results();

}  // namespace theatron::output
