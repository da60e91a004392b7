// SPDX-License-Identifier: Apache-2.0
// When the pictures of a played file are due, where its clock jumps. Pure.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "base/time.h"

namespace theatron::capture {

inline constexpr const char* jump_remark =
    "times jump by more than an hour, and the next picture follows at once";

class SteadyTimes {
public:
    // Nobody waits longer for the next picture. Slides of a talk stand for minutes; a clock that
    // was set jumps by an hour or a day, and so do files that were put together of others.
    static constexpr Duration longest_gap = std::chrono::hours(1);

    // How long after the first picture that of `time` is due. Times that go back are those of the
    // picture before.
    Duration due(Duration time, Duration period) {
        if (last_ && time - *last_ > longest_gap) {
            due_ += period;
            jumped_ = true;
        } else if (last_) {
            due_ += std::max(time - *last_, Duration(0));
        }
        last_ = last_ ? std::max(*last_, time) : time;
        return due_;
    }
    bool jumped() const { return jumped_; }

private:
    std::optional<Duration> last_;  // the latest time of the file
    Duration due_{};
    bool jumped_ = false;
};

}  // namespace theatron::capture
