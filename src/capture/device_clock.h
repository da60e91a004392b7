// SPDX-License-Identifier: Apache-2.0
// When a live camera's picture was taken, in this machine's steady clock. Pure:
// the time is passed in.
//
// The camera's own clock is even but counts from an unknown beginning. When the
// host got to know of a picture is known, but late by a delay that differs from
// picture to picture. The shortest delay seen ties the two together.
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/time.h"

namespace theatron::capture {

// Both clocks of this machine at one moment.
struct HostNow {
    TimePoint steady;
    Duration since_1970{};
};

// When the host got a picture, from the time that the camera's library put on
// it. Azure's library counts nanoseconds of the steady clock, Orbbec's those
// since 1970, and others none; then it is `usual_delay` before `now`.
inline TimePoint host_time(std::uint64_t system_ns, HostNow now, Duration usual_delay) {
    // Longer ago, it is no time of arrival but something else.
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
    // The moment of a picture that the camera dates `device` and the host knew
    // of at `host`. Never later than `host`. A camera without clock says 0.
    TimePoint captured(Duration device, TimePoint host) {
        if (device <= Duration(0))
            return host;
        const Duration offset = host.time_since_epoch() - device;
        // Clocks drift apart, so the shortest delay may not count for ever.
        const Duration drift = (device - last_) / drift_divisor;
        const bool restarted = device < last_ || offset - offset_ > jump;
        offset_ = !known_ || restarted ? offset : std::min(offset, offset_ + drift);
        known_ = true;
        last_ = device;
        return TimePoint(device + offset_);
    }

private:
    static constexpr int drift_divisor = 5000;  // 200 ppm, more than any crystal is off
    static constexpr Duration jump = 500ms;     // longer than any delay of a working camera

    bool known_ = false;
    Duration offset_{};  // host - device
    Duration last_{};
};

}  // namespace theatron::capture
