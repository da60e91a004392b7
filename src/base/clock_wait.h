// SPDX-License-Identifier: Apache-2.0
// Waiting by the steady clock (base/steady_clock.h). In the World (tests/world), whose time passes
// only with its events, it runs these meanwhile.
#pragma once

#include <condition_variable>
#include <mutex>

#include "base/time.h"

namespace theatron {

// Waits until `condition`, which another thread makes true and notifies, at most for `patience`.
// Returns the condition. `lock` is held.
template <class Condition>
bool wait_for(std::condition_variable& changed, std::unique_lock<std::mutex>& lock,
              Duration patience, Condition condition) {
    return changed.wait_for(lock, patience, condition);
}

// The same without a bound.
template <class Condition>
void wait(std::condition_variable& changed, std::unique_lock<std::mutex>& lock,
          Condition condition) {
    changed.wait(lock, condition);
}

}  // namespace theatron
