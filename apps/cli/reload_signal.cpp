// SPDX-License-Identifier: Apache-2.0
#include "cli/reload_signal.h"

#include <atomic>
#include <csignal>

namespace theatron::cli {
namespace {

std::atomic<bool> wants_reload{false};
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

void catch_reload_signal() {
    std::signal(SIGHUP, [](int) { wants_reload = true; });
}

bool take_reload_signal() {
    return wants_reload.exchange(false);
}

}  // namespace theatron::cli
