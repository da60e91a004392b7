// SPDX-License-Identifier: Apache-2.0
// When a receiver may connect to a relay again. It belongs to the relay, whatever grants for it
// come and go: else each new one would be an attempt at once. Time is passed in.
#pragma once

#include <algorithm>

#include "base/time.h"

namespace theatron::session {

class RelayPace {
public:
    // The first pause between two attempts, which doubles up to the longest.
    RelayPace(Duration first, Duration longest)
        : first_(first), longest_(longest), pause_(first), last_(first) {}

    // The time until the next attempt.
    Duration wait(TimePoint now) const { return std::max(next_ - now, Duration(0)); }
    void on_attempt(TimePoint now) {
        next_ = now + pause_;
        last_ = pause_;
        pause_ = std::min(2 * pause_, longest_);
    }
    // The attempt, or the connection that it led to, is over; `proven`: that one had lasted.
    void on_end(TimePoint now, bool proven) {
        if (proven) {
            last_ = first_;
            pause_ = 2 * first_;
        }
        next_ = now + last_;
    }
    // Nothing is lost with it any more.
    bool is_over(TimePoint now) const { return now - next_ > longest_; }

private:
    const Duration first_, longest_;
    TimePoint next_;
    Duration pause_, last_;  // the next one, and that before the present attempt
};

}  // namespace theatron::session
