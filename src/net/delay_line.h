// SPDX-License-Identifier: Apache-2.0
// Envelopes that wait for a fixed time, in their order, so that a connection is as late as one over
// a longer way (docs/studies.md).
//
// Pure; time is passed in.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "base/bytes.h"
#include "base/time.h"

namespace theatron::net {

class DelayLine {
public:
    // For envelopes from now on; those that wait keep their time, and nothing overtakes them.
    void set_delay(Duration delay) { delay_ = delay; }
    Duration delay() const { return delay_; }
    // False: an envelope may pass beside the line.
    bool is_used() const { return delay_ > Duration(0) || !waiting_.empty(); }

    void push(Bytes envelope, TimePoint now) {
        bytes_ += envelope.size();
        TimePoint due = now + delay_;
        if (!waiting_.empty())
            due = std::max(due, waiting_.back().first);
        waiting_.emplace_back(due, std::move(envelope));
    }
    // The rest is `wanted` alone, without delay, and so is what comes from now on.
    void hurry(const std::function<bool(ByteView)>& wanted) {
        delay_ = Duration(0);
        std::erase_if(waiting_, [&](const auto& entry) { return !wanted(entry.second); });
        bytes_ = 0;
        for (auto& [due, envelope] : waiting_) {
            due = TimePoint{};
            bytes_ += envelope.size();
        }
    }
    // When the next one leaves; nullopt: none waits.
    std::optional<TimePoint> due() const {
        return waiting_.empty() ? std::nullopt : std::optional(waiting_.front().first);
    }
    // The next one, if its time has come.
    std::optional<Bytes> take(TimePoint now) {
        if (waiting_.empty() || waiting_.front().first > now)
            return std::nullopt;
        Bytes envelope = std::move(waiting_.front().second);
        waiting_.pop_front();
        bytes_ -= envelope.size();
        return envelope;
    }
    std::size_t bytes() const { return bytes_; }

private:
    Duration delay_{};
    std::deque<std::pair<TimePoint, Bytes>> waiting_;
    std::size_t bytes_ = 0;
};

}  // namespace theatron::net
