// SPDX-License-Identifier: Apache-2.0
#include "sandbox/spawn.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

#include <cstring>
#include <string_view>
#include <utility>

#include "sandbox/filter.h"
#include "sandbox/spawn_plan.h"

extern char** environ;

namespace theatron::sandbox {
namespace {

// The variables that a program needs to start. A reader gets no others.
std::vector<char*> small_environment() {
    std::vector<char*> kept;
    for (char** entry = environ; *entry; ++entry) {
        const std::string_view name = std::string_view(*entry).substr(0, std::strcspn(*entry, "="));
        if (name == "LD_LIBRARY_PATH" || name.ends_with("SAN_OPTIONS"))
            kept.push_back(*entry);
    }
    kept.push_back(nullptr);
    return kept;
}

}  // namespace

pid_t spawn(const SpawnOptions& options) {
    std::vector<std::string> words = options.arguments;
    words.insert(words.begin(), program_invocation_short_name);
    SpawnPlan plan("a reader");
    plan.to_null(STDIN_FILENO, O_RDONLY);
    plan.to_null(STDOUT_FILENO, O_WRONLY);
    // Reports of a sanitizer must stay visible.
    if (!has_sanitizer)
        plan.to_null(STDERR_FILENO, O_WRONLY);
    plan.move(options.channel, channel_descriptor);
    plan.move(options.input, input_descriptor);
    plan.move(options.area, area_descriptor);
    plan.close_from(area_descriptor + 1);
    return plan.start("/proc/self/exe", std::move(words), small_environment().data());
}

}  // namespace theatron::sandbox
