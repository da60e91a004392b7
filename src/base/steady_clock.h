// SPDX-License-Identifier: Apache-2.0
// This process's steady clock, in the type of the session clock; on the host the two are the same,
// and a participant adds the offset it estimated. Read by programs and by modules that own threads,
// devices, sockets or windows; all others take the time as an argument.
#pragma once

#include "base/time.h"

namespace theatron {

inline TimePoint steady_now() {
    return TimePoint(
        std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch()));
}

}  // namespace theatron
