// SPDX-License-Identifier: Apache-2.0
#include "files/utc_text.h"

#include <chrono>
#include <cstdio>

#include "base/utc.h"

namespace theatron::files {

UtcSeconds utc_now() {
    const auto now = std::chrono::floor<std::chrono::seconds>(theatron::utc_now());
    return now.time_since_epoch().count();
}

std::string utc_text(UtcSeconds time) {
    using namespace std::chrono;
    constexpr UtcSeconds end_of_9999 = 253'402'300'799;
    if (time < 0 || time > end_of_9999)
        return "";
    const sys_seconds at{seconds(time)};
    const auto day = floor<days>(at);
    const year_month_day date(day);
    const hh_mm_ss clock(at - day);
    char text[40];
    std::snprintf(text, sizeof(text), "%04d-%02u-%02uT%02d:%02d:%02dZ", int(date.year()),
                  unsigned(date.month()), unsigned(date.day()), int(clock.hours().count()),
                  int(clock.minutes().count()), int(clock.seconds().count()));
    return text;
}

std::optional<UtcSeconds> parse_utc(std::string_view text) {
    using namespace std::chrono;
    int year_number = 0, month_number = 0, day_number = 0, hour = 0, minute = 0, second = 0;
    if (std::sscanf(std::string(text).c_str(), "%4d-%2d-%2dT%2d:%2d:%2dZ", &year_number,
                    &month_number, &day_number, &hour, &minute, &second) != 6)
        return std::nullopt;
    const year_month_day date{year(year_number), month(unsigned(month_number)),
                              day(unsigned(day_number))};
    if (!date.ok())
        return std::nullopt;
    const auto at = sys_days(date) + hours(hour) + minutes(minute) + seconds(second);
    const UtcSeconds time = duration_cast<seconds>(at.time_since_epoch()).count();
    // Only the one spelling.
    return utc_text(time) == text ? std::optional(time) : std::nullopt;
}

}  // namespace theatron::files
