// SPDX-License-Identifier: Apache-2.0
#include "cli/stop_signal.h"

#include <atomic>
#include <csignal>

namespace theatron::cli {
namespace {

std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

void catch_stop_signals() {
    const auto stop = [](int) { requested = true; };
    std::signal(SIGINT, stop);
    std::signal(SIGTERM, stop);
    // A command that was started to outlive its terminal (nohup) ignores it; that is kept.
    if (std::signal(SIGHUP, stop) == SIG_IGN)
        std::signal(SIGHUP, SIG_IGN);
}

bool stop_requested() {
    return requested;
}

}  // namespace theatron::cli
