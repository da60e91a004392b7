// SPDX-License-Identifier: Apache-2.0
#include "this_machine.h"

#include <fstream>
#include <thread>

#include "base/machine_load.h"

namespace theatron::bench {

std::string processor_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name"))
            return line.substr(line.find(':') + 2);
    return "processor of unknown name";
}

double cores_of_others() {
    MachineLoad load;
    (void)load.since_last();
    std::this_thread::sleep_for(std::chrono::seconds(1));
    return load.since_last() * std::thread::hardware_concurrency();
}

}  // namespace theatron::bench
