// SPDX-License-Identifier: Apache-2.0
#include "net/clock_sync.h"

#include <algorithm>

namespace theatron::net {

void ClockSync::add(TimePoint local_sent, TimePoint host_received, TimePoint host_sent,
                    TimePoint local_received) {
    const Duration round_trip = (local_received - local_sent) - (host_sent - host_received);
    // An answer from before its question is not a measurement.
    if (round_trip < Duration(0) || host_sent < host_received)
        return;
    const Duration offset = ((host_received - local_sent) + (host_sent - local_received)) / 2;
    exchanges_[count_++ % exchanges_.size()] = {offset, round_trip};
}

void ClockSync::forget() {
    forgotten_ = offset();
    count_ = 0;
}

const ClockSync::Exchange& ClockSync::best() const {
    const auto end = exchanges_.begin() + std::ptrdiff_t(std::min(count_, exchanges_.size()));
    return *std::min_element(exchanges_.begin(), end, [](const Exchange& a, const Exchange& b) {
        return a.round_trip < b.round_trip;
    });
}

Duration ClockSync::offset() const {
    return known() ? best().offset : forgotten_;
}

Duration ClockSync::error_bound() const {
    return known() ? best().round_trip / 2 : Duration::max();
}

Duration ClockSync::round_trip() const {
    return known() ? best().round_trip : Duration::max();
}

}  // namespace theatron::net
