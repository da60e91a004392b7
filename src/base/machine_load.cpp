// SPDX-License-Identifier: Apache-2.0
#include "base/machine_load.h"

#include <sstream>
#include <string>

namespace theatron {

std::optional<MachineTimes> parse_machine_times(std::string_view stat) {
    std::istringstream words{std::string(stat.substr(0, stat.find('\n')))};
    std::string name;
    // user, nice, system, idle, waiting for input or output, interrupts (2), stolen
    double ticks[8] = {};
    words >> name;
    for (double& t : ticks)
        words >> t;
    if (!words || name != "cpu")
        return std::nullopt;
    MachineTimes times{.yielding = ticks[1]};
    for (const double t : ticks)
        times.all += t;
    times.busy = times.all - times.yielding - ticks[3] - ticks[4];
    return times;
}

double busy_share(const MachineTimes& before, const MachineTimes& now) {
    return now.all > before.all ? (now.busy - before.busy) / (now.all - before.all) : 0;
}

}  // namespace theatron
