// SPDX-License-Identifier: Apache-2.0
// What parent and child agree on. Only for this module.
#pragma once

#include <cstddef>

namespace theatron::sandbox {

// Arguments of a child: this, the reader's name, then numbers.
inline constexpr const char* child_argument = "--sandboxed-reader";
enum Argument : int {
    name_argument = 2,
    parent_argument,
    area_argument,
    memory_argument,
    cpu_argument,
    unfiltered_argument,  // 1: runs also where the system has no filter
    argument_count
};

// The first message of a child, one byte.
enum class Ready : unsigned char { filtered = 1, unfiltered = 2 };

// How a child ends by itself.
enum Ending : int {
    ended_well = 0,
    ended_no_limits = 101,
    ended_no_filter = 102,
    ended_out_of_memory = 103,
    ended_by_exception = 104,
};

// Set by run_as_child(): a program without it would start itself again and again.
bool can_start_children();

}  // namespace theatron::sandbox
