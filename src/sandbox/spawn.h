// SPDX-License-Identifier: Apache-2.0
// Starts this program again as a child that has nothing of its parent's but what it is given.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace theatron::sandbox {

struct SpawnOptions {
    std::vector<std::string> arguments;       // without the program's name
    int channel = -1, input = -1, area = -1;  // stay the caller's
};

// The child's number. It ends with this process, not with the calling thread. Throws Error.
pid_t spawn(const SpawnOptions& options);

}  // namespace theatron::sandbox
