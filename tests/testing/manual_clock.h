// SPDX-License-Identifier: Apache-2.0
// Time that passes when a test says so, or when somebody sleeps; never by itself.
#pragma once

#include <algorithm>
#include <atomic>

#include "base/time.h"

namespace theatron::testing {

class ManualClock {
public:
    TimePoint now() const { return TimePoint(now_.load()); }
    void pass(Duration time) { now_ = now_.load() + std::max(time, Duration(0)); }

    // As the struct of functions that a constructor takes (capture/clock.h).
    template <class Clock>
    Clock as() {
        return {[this] { return now(); }, [this](Duration time) { pass(time); }};
    }

private:
    std::atomic<Duration> now_{Duration(1h)};
};

}  // namespace theatron::testing
