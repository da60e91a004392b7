// SPDX-License-Identifier: Apache-2.0
// When a connection counts as lost although nothing has closed it: the other side is silent, or
// this machine has slept.
//
// Natively, pings of the WebSocket notice it. A browser shows them to no script, so a page measures
// the time from its own messages, which the host answers.
#pragma once

#include <optional>

#include "base/time.h"

namespace theatron::net {

class Silence {
public:
    // From a message until anything comes back.
    static constexpr Duration longest = std::chrono::seconds(30);
    // From the first packet to an open WebSocket.
    static constexpr Duration longest_handshake = std::chrono::seconds(10);
    // For which a machine may have slept without a new connection.
    static constexpr Duration longest_sleep = std::chrono::seconds(10);

    void sent(TimePoint now) {
        if (!asked_)
            asked_ = now;
    }
    void heard() { asked_.reset(); }
    bool is_too_long(TimePoint now) const { return asked_ && now - *asked_ > longest; }

    // To be called often with both clocks; `wall` is any clock that goes on while the machine
    // sleeps. True if the steady clock stood still between two calls for longer than
    // longest_sleep. Setting the machine's time forward looks the same.
    bool has_slept(TimePoint now, TimePoint wall) {
        const Duration ahead = wall - now;
        const bool slept = ahead_ && ahead - *ahead_ > longest_sleep;
        ahead_ = ahead;
        return slept;
    }

private:
    std::optional<TimePoint> asked_;  // the first message that nothing followed
    std::optional<Duration> ahead_;   // of the wall clock, at the last call
};

}  // namespace theatron::net
