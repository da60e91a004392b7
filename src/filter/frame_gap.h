// SPDX-License-Identifier: Apache-2.0
// The effect of the time between two frames on filters with memory.
#pragma once

#include <algorithm>

#include "base/time.h"

namespace theatron::filter {

// The gains of the Kalman filter hold for 30 frames a second.
inline constexpr Duration nominal_period = std::chrono::microseconds(33'333);
inline constexpr Duration longest_memory = std::chrono::seconds(1);

class FrameGap {
public:
    struct Meaning {
        bool forgets = false;  // true: earlier frames are discarded
        int missed = 0;        // frames that are missing, at the nominal rate
    };
    Meaning next(Duration since_last_frame) {
        const bool forgets =
            first_ || since_last_frame < Duration(0) || since_last_frame > longest_memory;
        first_ = false;
        const auto frames = (since_last_frame + nominal_period / 2) / nominal_period;
        return {forgets, forgets ? 0 : int(std::max<Duration::rep>(frames - 1, 0))};
    }

private:
    bool first_ = true;
};

}  // namespace theatron::filter
