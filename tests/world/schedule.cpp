// SPDX-License-Identifier: Apache-2.0
#include "world/schedule.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "base/fault.h"

namespace theatron::world {
namespace {

// Events without time passing: more are events that cause one another for ever.
constexpr int most_at_once = 1'000'000;
int at_once = 0;  // used by the owner

}  // namespace

Schedule& Schedule::instance() {
    static Schedule only;
    return only;
}

void Schedule::begin() {
    // Their handlers may cancel other events: destroyed without the mutex.
    std::map<Key, std::function<void()>> old;
    const std::lock_guard lock(mutex_);
    old.swap(events_);
    now_ = TimePoint(1h);
    next_ = 0;
    owner_ = std::this_thread::get_id();
}

TimePoint Schedule::now() const {
    const std::lock_guard lock(mutex_);
    return now_;
}

Schedule::Key Schedule::at(TimePoint when, std::function<void()> event) {
    const std::lock_guard lock(mutex_);
    const Key key{std::max(when, now_), next_++};
    events_.emplace(key, std::move(event));
    return key;
}

void Schedule::cancel(const Key& key) {
    std::function<void()> event;  // destroyed without the mutex
    const std::lock_guard lock(mutex_);
    if (const auto found = events_.find(key); found != events_.end()) {
        event = std::move(found->second);
        events_.erase(found);
    }
}

std::size_t Schedule::size() const {
    const std::lock_guard lock(mutex_);
    return events_.size();
}

bool Schedule::is_owner() const {
    const std::lock_guard lock(mutex_);
    return owner_ == std::this_thread::get_id();
}

bool Schedule::step(TimePoint then) {
    std::function<void()> event;
    {
        const std::lock_guard lock(mutex_);
        if (events_.empty() || events_.begin()->first.first > then) {
            now_ = std::max(now_, then);
            return false;
        }
        const TimePoint next = std::max(now_, events_.begin()->first.first);
        at_once = next > now_ ? 0 : at_once + 1;
        now_ = next;
        event = std::move(events_.begin()->second);
        events_.erase(events_.begin());
    }
    if (at_once > most_at_once) {
        std::fputs("The World's time stands still: one event causes the next.\n", stderr);
        std::abort();
    }
    (void)contain("world", event);
    return true;
}

void Schedule::advance(Duration time) {
    const TimePoint then = now() + time;
    while (step(then)) {
    }
}

}  // namespace theatron::world
