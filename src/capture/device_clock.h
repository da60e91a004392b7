// SPDX-License-Identifier: Apache-2.0
// Converts the time of a live camera's picture to this machine's steady clock. Pure: the time
// is passed in.
//
// The camera's own clock is regular but has an unknown offset. The host knows the arrival of a
// picture, which has a varying delay. The offset follows from the shortest delay seen.
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/time.h"

namespace theatron::capture {

// Both clocks of this machine, read together.
struct HostNow {
    TimePoint steady;
    Duration since_1970{};
};

// The arrival of a picture at the host, from the time stamp of the camera's library. Azure's
// library counts nanoseconds of the steady clock, Orbbec's nanoseconds since 1970; others have
// no stamp, and then the arrival is taken as `usual_delay` before `now`.
inline TimePoint host_time(std::uint64_t system_ns, HostNow now, Duration usual_delay) {
    // A longer delay means that the stamp is not a time of arrival.
    constexpr Duration longest_delay = 1s;
    const Duration stamp(std::int64_t(system_ns / 1000));
    const Duration since_boot = now.steady.time_since_epoch();
    for (const Duration age : {since_boot - stamp, now.since_1970 - stamp})
        if (age >= Duration(0) && age <= longest_delay)
            return now.steady - age;
    return now.steady - usual_delay;
}

class DeviceClock {
public:
    // The capture time of a picture with device time `device` that arrived at `host`. Never
    // later than `host`. `device` is 0 for a camera without a clock.
    TimePoint captured(Duration device, TimePoint host) {
        if (device <= Duration(0))
            return host;
        const Duration offset = host.time_since_epoch() - device;
        // The clocks drift, so the shortest delay must expire.
        const Duration drift = (device - last_) / drift_divisor;
        const bool restarted = device < last_ || offset - offset_ > jump;
        offset_ = !known_ || restarted ? offset : std::min(offset, offset_ + drift);
        known_ = true;
        last_ = device;
        return TimePoint(device + offset_);
    }

private:
    static constexpr int drift_divisor = 5000;  // 200 ppm, more than the error of any crystal
    static constexpr Duration jump = 500ms;     // longer than any delay of a working camera

    bool known_ = false;
    Duration offset_{};  // host - device
    Duration last_{};
};

}  // namespace theatron::capture
