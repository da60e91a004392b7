// SPDX-License-Identifier: Apache-2.0
// The resources used by a running process, from /proc. Linux only; empty elsewhere.
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
    std::map<int, Thread> threads;  // by thread id
};

ProcessUsage usage_of(int pid);

// The processor time of the whole machine since boot, summed over all cores.
double machine_cpu_seconds();

// The load of the busiest thread with this name between two samples, in cores.
double busiest(const ProcessUsage& before, const ProcessUsage& after, const std::string& name,
               double seconds);

}  // namespace theatron::bench
