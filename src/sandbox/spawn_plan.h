// SPDX-License-Identifier: Apache-2.0
// Starts a program as a child that inherits the descriptors which it is given. Ctrl-C in the
// terminal is for the parent only.
#pragma once

#include <spawn.h>
#include <sys/types.h>

#include <string>
#include <vector>

namespace theatron::sandbox {

class SpawnPlan {
public:
    // `what` of Error's sentences: "a reader".
    explicit SpawnPlan(std::string what);
    ~SpawnPlan();
    SpawnPlan(const SpawnPlan&) = delete;
    SpawnPlan& operator=(const SpawnPlan&) = delete;

    // The child's descriptor is /dev/null, opened with these flags.
    void to_null(int descriptor, int flags);
    // The child's descriptor `to` is `from`, which the caller owns. Throws Error.
    void move(int from, int to);
    void close_from(int first);

    // `words`: the program's name and its arguments. `environment` ends with a null pointer.
    // Returns the child's process id; as for PR_SET_PDEATHSIG, its parent ends with this process,
    // not with the thread. Throws Error.
    pid_t start(const char* program, std::vector<std::string> words, char** environment) const;

private:
    const std::string what_;
    posix_spawn_file_actions_t actions_;
    posix_spawnattr_t attributes_;
    std::vector<int> copies_;
};

}  // namespace theatron::sandbox
