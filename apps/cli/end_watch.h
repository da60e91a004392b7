// SPDX-License-Identifier: Apache-2.0
// When a program that was told to end is ended, whatever hangs in it (docs/decisions/leaving.md).
#pragma once

#include <algorithm>
#include <optional>
#include <set>

#include "base/time.h"

namespace theatron::cli {

// The time in which a program ends by itself, from when it was told to.
inline constexpr Duration end_within = std::chrono::seconds(2);
// The time that is left for this once everything is saved.
inline constexpr Duration end_after_saving = std::chrono::milliseconds(500);

// The rules without clock and threads.
class EndWatch {
public:
    // The first time counts.
    void tell(TimePoint now) {
        if (!told_at_)
            told_at_ = now;
    }
    // Something must be saved, for which the program has this long once it was told to end, or once
    // something else was saved after that.
    void begin_saving(Duration patience) { saving_.insert(patience); }
    // Something that was begun with this patience is saved.
    void end_saving(Duration patience, TimePoint now) {
        saving_.erase(saving_.find(patience));
        saved_at_ = now;
    }
    bool is_saving() const { return !saving_.empty(); }

    // When the program is to be ended; none until it was told to.
    std::optional<TimePoint> due() const {
        if (!told_at_)
            return std::nullopt;
        const TimePoint usual = *told_at_ + end_within;
        // The rest may have waited for what was saved just now, and has its own time from then.
        if (is_saving())
            return std::max(usual, *std::max(told_at_, saved_at_) + *saving_.rbegin());
        return saved_at_ ? std::max(usual, *saved_at_ + end_after_saving) : usual;
    }

private:
    std::optional<TimePoint> told_at_, saved_at_;
    std::multiset<Duration> saving_;  // the patience of each
};

}  // namespace theatron::cli
