// SPDX-License-Identifier: Apache-2.0
// Times of day, as files and figures store them beside session time: always UTC.
#pragma once

#include <chrono>
#include <string>

namespace theatron {

using UtcTime = std::chrono::sys_time<std::chrono::microseconds>;

// Read at the same instant as the session's clock, it tells what session time means.
inline UtcTime utc_now() {
    return std::chrono::floor<std::chrono::microseconds>(std::chrono::system_clock::now());
}

// RFC 3339 with milliseconds, rounded down: "2026-11-22T07:31:41.250Z". Empty for the epoch, which
// stands for an unknown time.
std::string utc_text(UtcTime time);

}  // namespace theatron
