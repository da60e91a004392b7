// SPDX-License-Identifier: Apache-2.0
// This process's steady clock, in the type of the session clock. On the host
// the two are the same clock; a participant adds the offset it estimated.
// Read only by apps, benchmarks and threads of capture, send and record.
#pragma once

#include "base/time.h"

namespace theatron {

inline TimePoint steady_now() {
    return TimePoint(
        std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch()));
}

}  // namespace theatron
