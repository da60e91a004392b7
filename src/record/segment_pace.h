// SPDX-License-Identifier: Apache-2.0
// When a recording may begin another segment because its cameras or voices have changed: a few at
// once, then, as long as they go on, one after 10 s, one after 20 s and so on, so that people who
// come and go make no thousands of files. Pure.
#pragma once

#include <algorithm>

#include "base/time.h"

namespace theatron::record {

class SegmentPace {
public:
    static constexpr int at_once = 12;
    static constexpr Duration first_wait = std::chrono::seconds(10),
                              longest_wait = std::chrono::seconds(160);
    // After this time without a segment, all is as at first.
    static constexpr Duration calm = std::chrono::minutes(10);

    bool may_begin(TimePoint now) const { return left_ > 0 || now - newest_ >= wait_; }
    // A segment has begun.
    void begin(TimePoint now) {
        if (now - newest_ >= calm) {
            left_ = at_once;
            wait_ = first_wait;
        }
        if (left_ > 0)
            --left_;
        else
            wait_ = std::min(2 * wait_, longest_wait);
        newest_ = now;
    }

private:
    int left_ = at_once;
    Duration wait_ = first_wait;  // after those
    TimePoint newest_;
};

}  // namespace theatron::record
