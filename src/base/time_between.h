// SPDX-License-Identifier: Apache-2.0
// Differences of times that come from outside.
#pragma once

#include <limits>

#include "base/time.h"

namespace theatron {

// Longer times are cut to this, so that a few of them can be added.
inline constexpr Duration most_time_between{std::numeric_limits<std::int64_t>::max() / 4};

// The time from `from` to `to`, which may have any value: no overflow.
constexpr Duration time_between(TimePoint from, TimePoint to) {
    const Duration half(to_us(to) / 2 - to_us(from) / 2);
    if (half >= most_time_between / 2)
        return most_time_between;
    if (half <= -most_time_between / 2)
        return -most_time_between;
    return to - from;
}

}  // namespace theatron
