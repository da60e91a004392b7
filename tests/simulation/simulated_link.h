// SPDX-License-Identifier: Apache-2.0
// A TCP connection over a link in made-up time: a rate with a deep buffer in
// front of it, a delay, and losses that hold everything back for a round trip.
#pragma once

#include <deque>
#include <optional>
#include <random>
#include <utility>

#include "base/bytes.h"
#include "base/time.h"

namespace theatron::testing {

class SimulatedLink {
public:
    explicit SimulatedLink(unsigned seed) : random_(seed) {}

    double bytes_per_second = 10e6;
    Duration delay = std::chrono::milliseconds(30);  // one way
    double loss = 0;                                 // chance of each envelope to be lost once

    void send(Bytes envelope, TimePoint now) {
        free_at_ = std::max(free_at_, now) +
                   seconds_to_duration(double(envelope.size()) / bytes_per_second);
        if (loss > 0 && std::uniform_real_distribution<>(0, 1)(random_) < loss)
            stalled_until_ = free_at_ + 3 * delay;
        arrives_ = std::max({arrives_, free_at_ + delay, stalled_until_});
        under_way_.push_back({arrives_, std::move(envelope)});
    }

    // Nothing arrives for so long, all the sooner afterwards.
    void stall(Duration length, TimePoint now) { stalled_until_ = now + length; }

    // When all that was sent has left its buffer.
    TimePoint free_at() const { return free_at_; }
    // When the envelope that was sent last arrives.
    TimePoint newest_arrival() const { return arrives_; }
    // When the next envelope arrives.
    std::optional<TimePoint> next_arrival() const {
        return under_way_.empty() ? std::nullopt : std::optional(under_way_.front().first);
    }

    // The next envelope that has arrived by now.
    bool receive(Bytes& envelope, TimePoint now) {
        if (under_way_.empty() || under_way_.front().first > now)
            return false;
        envelope = std::move(under_way_.front().second);
        under_way_.pop_front();
        return true;
    }

private:
    std::deque<std::pair<TimePoint, Bytes>> under_way_;
    TimePoint free_at_, arrives_, stalled_until_;
    std::mt19937 random_;
};

}  // namespace theatron::testing
