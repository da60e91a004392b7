// SPDX-License-Identifier: Apache-2.0
#include "base/utc.h"

#include <cstdio>
#include <ctime>

namespace theatron {

std::string utc_text(UtcTime time) {
    const auto whole = std::chrono::floor<std::chrono::seconds>(time);
    const std::time_t seconds = whole.time_since_epoch().count();
    std::tm parts{};
    if (time == UtcTime{} || !gmtime_r(&seconds, &parts))
        return "";
    char date[64], text[96];
    std::strftime(date, sizeof(date), "%Y-%m-%dT%H:%M:%S", &parts);
    std::snprintf(text, sizeof(text), "%s.%03dZ", date, int((time - whole).count() / 1000));
    return text;
}

}  // namespace theatron
