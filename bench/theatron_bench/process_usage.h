// SPDX-License-Identifier: Apache-2.0
// What a running process uses, as the system counts it. Linux only; elsewhere nothing.
#pragma once

#include <map>
#include <string>

namespace theatron::bench {

struct ProcessUsage {
    double cpu_seconds = 0;
    double memory_mb = 0;
    struct Thread {
        std::string name;
        double cpu_seconds = 0;
    };
    std::map<int, Thread> threads;  // by number
};

ProcessUsage usage_of(int pid);

// Of the whole machine since it was started, all cores together.
double machine_cpu_seconds();

// The busiest thread of that name between two looks, in cores.
double busiest(const ProcessUsage& before, const ProcessUsage& after, const std::string& name,
               double seconds);

}  // namespace theatron::bench
