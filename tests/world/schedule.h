// SPDX-License-Identifier: Apache-2.0
// The time of a World: it passes from event to event, and only while the test lets it.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "base/time.h"

namespace theatron::world {

// One for the process. Events are run by the thread that called begin(), in the order of their
// times, and those of one time in the order in which they were added.
class Schedule {
public:
    using Key = std::pair<TimePoint, std::uint64_t>;

    static Schedule& instance();

    // A new World: the time is the same each time, and no event is left.
    void begin();

    // From any thread.
    TimePoint now() const;
    Key at(TimePoint when, std::function<void()> event);
    Key after(Duration wait, std::function<void()> event) { return at(now() + wait, event); }
    void cancel(const Key& key);
    std::size_t size() const;
    bool is_owner() const;

    // By the owner, also from within an event. An exception of an event is a fault (base/fault.h).
    // Runs the next event that is due by then. False: there is none, and it is then.
    bool step(TimePoint then);
    void advance(Duration time);

private:
    mutable std::mutex mutex_;  // guards all below
    TimePoint now_;
    std::uint64_t next_ = 0;
    std::map<Key, std::function<void()>> events_;
    std::thread::id owner_;
};

}  // namespace theatron::world
