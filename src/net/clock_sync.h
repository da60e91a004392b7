// SPDX-License-Identifier: Apache-2.0
// How a participant knows the session clock: the four time points of an NTP
// exchange (RFC 5905, section 8), keeping the exchanges with the shortest round trip.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "base/time.h"

namespace theatron::net {

// Pure: all times are given. Not thread safe.
class ClockSync {
public:
    // One exchange: the participant's clock at sending and at arrival of the
    // answer, the host's clock at arrival of the question and at sending.
    void add(TimePoint local_sent, TimePoint host_received, TimePoint host_sent,
             TimePoint local_received);

    // For another connection: its session may have another clock.
    void forget();

    bool known() const { return count_ > 0; }

    // Session time minus local time. Where it is not known, what it was before forget(); at first
    // zero.
    Duration offset() const;

    // Largest difference between session time and local + offset(): half of the round trip of
    // the best exchange. It holds for any share of the round trip that each direction took.
    Duration error_bound() const;

    Duration round_trip() const;  // of the best exchange kept

private:
    struct Exchange {
        Duration offset{}, round_trip{};
    };
    const Exchange& best() const;

    // Clocks drift by some 50 us a second: only the recent exchanges count.
    std::array<Exchange, 16> exchanges_{};
    std::size_t count_ = 0;
    Duration forgotten_{};  // the offset
};

}  // namespace theatron::net
