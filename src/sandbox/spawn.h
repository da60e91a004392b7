// SPDX-License-Identifier: Apache-2.0
// Starts this program again as a child that inherits only what it is given.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace theatron::sandbox {

struct SpawnOptions {
    std::vector<std::string> arguments;       // without the program's name
    int channel = -1, input = -1, area = -1;  // owned by the caller
};

// Returns the child's process id. It ends with this process, not with the thread. Throws Error.
pid_t spawn(const SpawnOptions& options);

}  // namespace theatron::sandbox
