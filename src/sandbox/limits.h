// SPDX-License-Identifier: Apache-2.0
// What a child process that reads foreign bytes may do and use.
#pragma once

#include <cstddef>

#include "base/time.h"

namespace theatron::sandbox {

// Both: compute, take memory, read what the parent opened, answer the parent. No file, device or
// connection can be opened, no process or thread started, no signal sent.
enum class Profile {
    file,    // reads and seeks in a file
    source,  // reads from and writes to one connection, and waits for it
};

// What goes beyond one of these ends the child. Memory is counted on top of the program and the
// area, which parent and child share; processor time anew with every `answers_per_cpu_limit`
// answers.
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

// Where this is "1", a child also runs on a system that has no system-call filter.
inline constexpr const char* unfiltered_variable = "THEATRON_UNFILTERED_READERS";

}  // namespace theatron::sandbox
