// SPDX-License-Identifier: Apache-2.0
// The permissions and resource limits of a child process that reads foreign bytes.
#pragma once

#include <cstddef>

#include "base/time.h"

namespace theatron::sandbox {

// Allowed in all: compute, allocate, read the parent's descriptor, answer the parent. Not allowed:
// open a file, device or connection, start a process or thread, send a signal.
enum class Profile {
    file,     // may read and seek in a file
    library,  // the same; opening a file or starting a thread fails instead of ending the child
    source,   // may read from, write to and poll one connection
    stream,   // the same for a library: opening a file or starting a thread fails
    display,  // may also send and receive gathered messages on the connection: an X server's
    device,   // may poll, map and control one video device (V4L2)
};

// A child that exceeds a limit is ended. Memory excludes the program itself and the shared area;
// processor time starts again every `answers_per_cpu_limit` answers.
inline constexpr std::size_t max_memory_bytes = std::size_t(256) << 20;
inline constexpr std::size_t max_area_bytes = std::size_t(32) << 20;
inline constexpr int max_cpu_seconds = 30;
inline constexpr int answers_per_cpu_limit = 256;
inline constexpr Duration longest_start = 30s;
inline constexpr Duration longest_answer = 10s;
inline constexpr std::size_t max_message_bytes = 64;

struct Limits {
    std::size_t memory_bytes = max_memory_bytes;
    std::size_t area_bytes = max_area_bytes;
    int cpu_seconds = max_cpu_seconds;
    Duration start = longest_start;
    Duration answer = longest_answer;
};

// An environment variable: with "1", a child also runs without a system-call filter.
inline constexpr const char* unfiltered_variable = "THEATRON_UNFILTERED_READERS";

}  // namespace theatron::sandbox
