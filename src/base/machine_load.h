// SPDX-License-Identifier: Apache-2.0
// Load of the whole machine, as the system counts it. Linux only; 0 on other systems.
#pragma once

#include <optional>
#include <string_view>

namespace theatron {

// Time of all cores together since the machine was started, in the system's ticks.
struct MachineTimes {
    double busy = 0;  // of threads with the usual priority, of the system itself, and stolen
    double yielding =
        0;  // of threads with a lower priority (nice above 0): they make room for others
    double all = 0;
};

// From the first line of /proc/stat, proc(5). Empty if it is none.
std::optional<MachineTimes> parse_machine_times(std::string_view stat);

// Share of all cores, 0 to 1, that was busy between two of them; 0 if no time passed between them.
double busy_share(const MachineTimes& before, const MachineTimes& now);

// Measures between two calls. Not thread safe.
class MachineLoad {
public:
    // Share of all cores since the last call, 0 to 1, in which the system and threads of the usual
    // priority ran, those of this program among them; 0 at the first call. Threads with a lower
    // priority do not count: what a guest makes the host encode or shake hands for runs there, and
    // must not change what others get. They count if this program's first thread has a lower
    // priority.
    double since_last();

private:
    std::optional<MachineTimes> last_;
};

}  // namespace theatron
