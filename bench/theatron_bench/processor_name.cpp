// SPDX-License-Identifier: Apache-2.0
#include "processor_name.h"

#include <fstream>

namespace theatron::bench {

std::string processor_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name"))
            return line.substr(line.find(':') + 2);
    return "processor of unknown name";
}

}  // namespace theatron::bench
