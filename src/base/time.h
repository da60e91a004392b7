// SPDX-License-Identifier: Apache-2.0
// Time in a session: microseconds of the host's steady clock.
//
// Points in time are passed as arguments: modules without threads, devices and sockets of their
// own never read a clock (steady_clock.h), so that they can be tested with made-up time.
#pragma once

#include <chrono>
#include <cstdint>

namespace theatron {

// The session clock has no now(): a participant only estimates it.
struct SessionClock {
    using rep = std::int64_t;
    using period = std::micro;
    using duration = std::chrono::duration<rep, period>;
    using time_point = std::chrono::time_point<SessionClock>;
    static constexpr bool is_steady = true;
};

using Duration = SessionClock::duration;
using TimePoint = SessionClock::time_point;

using namespace std::chrono_literals;

constexpr std::int64_t to_us(TimePoint t) {
    return t.time_since_epoch().count();
}
constexpr TimePoint from_us(std::int64_t us) {
    return TimePoint(Duration(us));
}
constexpr double to_ms(Duration d) {
    return double(d.count()) / 1000.0;
}
constexpr double to_seconds(Duration d) {
    return double(d.count()) / 1e6;
}

// From seconds with a fraction, rounded to the microsecond.
constexpr Duration seconds_to_duration(double seconds) {
    return Duration(std::int64_t(seconds * 1e6 + (seconds < 0 ? -0.5 : 0.5)));
}

}  // namespace theatron
