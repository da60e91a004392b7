// SPDX-License-Identifier: Apache-2.0
#include "process_usage.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace theatron::bench {
namespace {

namespace fs = std::filesystem;

// proc(5): the name in brackets may contain any character; times are fields 14 and 15.
ProcessUsage::Thread read_stat(const fs::path& file) {
    std::string text;
    std::getline(std::ifstream(file), text);
    const auto open = text.find('('), close = text.rfind(')');
    if (open == std::string::npos || close == std::string::npos)
        return {};
    std::istringstream rest(text.substr(close + 1));
    std::string skipped;
    for (int field = 3; field < 14; ++field)
        rest >> skipped;
    double user = 0, system = 0;
    rest >> user >> system;
    return {text.substr(open + 1, close - open - 1),
            (user + system) / double(sysconf(_SC_CLK_TCK))};
}

}  // namespace

ProcessUsage usage_of(int pid) {
    const fs::path process = "/proc/" + std::to_string(pid);
    ProcessUsage usage;
    usage.cpu_seconds = read_stat(process / "stat").cpu_seconds;
    double pages = 0;
    std::ifstream(process / "statm") >> pages >> pages;  // the second number: resident pages
    usage.memory_mb = pages * double(sysconf(_SC_PAGESIZE)) / (1 << 20);
    std::error_code gone;
    for (const auto& thread : fs::directory_iterator(process / "task", gone))
        usage.threads[std::atoi(thread.path().filename().c_str())] =
            read_stat(thread.path() / "stat");
    return usage;
}

double machine_cpu_seconds() {
    std::ifstream file("/proc/stat");
    std::string cpu;
    double user = 0, nice = 0, system = 0, idle = 0, waiting = 0, irq = 0, soft = 0, stolen = 0;
    file >> cpu >> user >> nice >> system >> idle >> waiting >> irq >> soft >> stolen;
    return (user + nice + system + irq + soft + stolen) / double(sysconf(_SC_CLK_TCK));
}

double busiest(const ProcessUsage& before, const ProcessUsage& after, const std::string& name,
               double seconds) {
    double most = 0;
    for (const auto& [number, thread] : after.threads) {
        const auto old = before.threads.find(number);
        if (thread.name == name && old != before.threads.end())
            most = std::max(most, thread.cpu_seconds - old->second.cpu_seconds);
    }
    return most / seconds;
}

}  // namespace theatron::bench
