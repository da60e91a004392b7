// SPDX-License-Identifier: Apache-2.0
// Waiting in the World; see steady_clock.h beside this.
#pragma once

#include <condition_variable>
#include <mutex>

#include "base/time.h"
#include "world/schedule.h"

namespace theatron {
inline namespace world_time {

// The thread of the World runs its events meanwhile; others really wait.
template <class Condition>
bool wait_for(std::condition_variable& changed, std::unique_lock<std::mutex>& lock,
              Duration patience, Condition condition) {
    world::Schedule& schedule = world::Schedule::instance();
    if (!schedule.is_owner())
        return changed.wait_for(lock, patience, condition);
    const TimePoint then = schedule.now() + patience;
    bool more = true;
    while (!condition() && more) {
        lock.unlock();
        more = schedule.step(then);
        lock.lock();
    }
    return condition();
}

template <class Condition>
void wait(std::condition_variable& changed, std::unique_lock<std::mutex>& lock,
          Condition condition) {
    constexpr Duration some_events = std::chrono::seconds(1);
    while (!wait_for(changed, lock, some_events, condition)) {
    }
}

}  // namespace world_time
}  // namespace theatron
