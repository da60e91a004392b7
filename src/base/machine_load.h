// SPDX-License-Identifier: Apache-2.0
// Load of the whole machine, as the system counts it. Linux only; 0 on other systems.
#pragma once

namespace theatron {

// Measures between two calls. Not thread safe.
class MachineLoad {
public:
    // Busy share of all cores since the last call, 0 to 1; 0 at the first call.
    double since_last();

private:
    double busy_ = 0, all_ = 0;  // since the machine was started, in the system's ticks
};

}  // namespace theatron
