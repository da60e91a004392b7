// SPDX-License-Identifier: Apache-2.0
// The time as cameras and what watches them see it. Tests give them one that passes when they say
// so.
#pragma once

#include <functional>

#include "base/time.h"

namespace theatron::capture {

struct Clock {
    std::function<TimePoint()> now;
    std::function<void(Duration)> sleep;
};

// This process's steady clock (base/steady_clock.h).
Clock steady_clock();

}  // namespace theatron::capture
