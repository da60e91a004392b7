// SPDX-License-Identifier: Apache-2.0
// Decides whether a connection's link loses packets by chance, and not once because it is full.
// Pure: time is an argument.
#pragma once

#include <cstdint>
#include <deque>

#include "base/time.h"

namespace theatron::net {

class LossWatch {
public:
    // A link that became full loses many packets within two or three round trips: one event. The
    // longer this is, the more of the first pictures CUBIC leaves out on a link that loses.
    static constexpr Duration of_one_event = std::chrono::milliseconds(150);
    static constexpr Duration span = std::chrono::seconds(10);
    static constexpr std::size_t events_of_a_losing_link = 3;  // within the span

    // `sent_again`: packets since the connection began (net/tcp_path.h). True from the first time
    // at which the link counts as one that loses.
    bool note(std::uint32_t sent_again, TimePoint now) {
        if (sent_again > sent_again_ && (events_.empty() || now - events_.back() >= of_one_event))
            events_.push_back(now);
        sent_again_ = sent_again;
        while (!events_.empty() && now - events_.front() > span)
            events_.pop_front();
        loses_ = loses_ || events_.size() >= events_of_a_losing_link;
        return loses_;
    }

private:
    std::uint32_t sent_again_ = 0;
    std::deque<TimePoint> events_;  // when packets had been sent again
    bool loses_ = false;
};

}  // namespace theatron::net
