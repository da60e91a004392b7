// SPDX-License-Identifier: Apache-2.0
// Foretells when a loudspeaker asks for its next samples, from when it has asked so far.
//
// The earliest calls decide: a call that comes late, or two that come at once, move the prediction
// by little. The clock of the device may be slower than this machine's by 1 in 500.
//
// Pure; time is passed in. Not thread safe.
#pragma once

#include <array>
#include <cstddef>

#include "base/time.h"

namespace theatron::voice {

class DevicePace {
public:
    // A device that asked for nothing for longer, after its time, begins anew.
    static constexpr Duration longest_silence = std::chrono::milliseconds(50);

    // The device has asked for this number of samples of each channel, more than 0, in one call.
    void note(std::size_t samples, TimePoint at);
    // True after the first call.
    bool is_known() const { return block_ > 0; }
    // Samples of the next call: as many as the largest of the last calls had.
    std::size_t block() const { return block_; }

    // Samples, behind those that were asked for, for which the device will have asked at this time:
    // whole blocks.
    std::size_t asked_until(TimePoint time) const;
    // The time at which the device asks for the block that has this sample, counted as above.
    TimePoint time_of(std::size_t sample) const;

private:
    std::array<std::size_t, 16> blocks_{};  // of the last calls, a ring
    std::size_t oldest_ = 0;
    std::size_t block_ = 0;
    double next_us_ = 0;  // of the next call
};

}  // namespace theatron::voice
