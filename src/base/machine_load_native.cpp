// SPDX-License-Identifier: Apache-2.0
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "base/machine_load.h"

namespace theatron {

double MachineLoad::since_last() {
    std::ifstream file("/proc/stat");
    std::string line;
    std::getline(file, line);
    std::optional<MachineTimes> now = parse_machine_times(line);
    if (now && getpriority(PRIO_PROCESS, id_t(getpid())) > 0)
        now->busy += now->yielding;
    const double share = last_ && now ? busy_share(*last_, *now) : 0;
    last_ = now;
    return share;
}

}  // namespace theatron
