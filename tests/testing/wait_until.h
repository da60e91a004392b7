// SPDX-License-Identifier: Apache-2.0
// Waits for what another thread does, for as long as that takes: CTest ends a test that hangs, and
// its output names it.
#pragma once

#include <chrono>
#include <thread>

namespace theatron::testing {

template <class Condition>
void wait_until(Condition&& condition) {
    while (!condition())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace theatron::testing
