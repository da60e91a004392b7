// SPDX-License-Identifier: Apache-2.0
#include "base/machine_load.h"

#include <fstream>
#include <string>

namespace theatron {

double MachineLoad::since_last() {
    std::ifstream file("/proc/stat");
    std::string name;
    // user, nice, system, idle, waiting for input or output, interrupts (2), stolen
    double ticks[8] = {};
    file >> name;
    for (double& t : ticks)
        file >> t;
    if (!file)
        return 0;
    double all = 0;
    for (const double t : ticks)
        all += t;
    const double busy = all - ticks[3] - ticks[4];
    const double share = all_ > 0 && all > all_ ? (busy - busy_) / (all - all_) : 0;
    busy_ = busy;
    all_ = all;
    return share;
}

}  // namespace theatron
