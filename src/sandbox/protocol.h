// SPDX-License-Identifier: Apache-2.0
// The protocol between parent and child. Private to this module.
#pragma once

#include <cstddef>

namespace theatron::sandbox {

// Arguments of a child: child_argument, the reader's name, then numbers.
inline constexpr const char* child_argument = "--sandboxed-reader";
enum Argument : int {
    name_argument = 2,
    parent_argument,
    area_argument,
    memory_argument,
    cpu_argument,
    unfiltered_argument,  // 1: run even if the system has no filter
    argument_count
};

// The first message of a child, one byte.
enum class Ready : unsigned char { filtered = 1, unfiltered = 2 };

// Exit codes of a child.
enum Ending : int {
    ended_well = 0,
    ended_no_limits = 101,
    ended_no_filter = 102,
    ended_out_of_memory = 103,
    ended_by_exception = 104,
};

// True after run_as_child(): without it the child would start children of its own, endlessly.
bool can_start_children();

}  // namespace theatron::sandbox
