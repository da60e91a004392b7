// SPDX-License-Identifier: Apache-2.0
#include "capture/clock.h"

#include <thread>

#include "base/steady_clock.h"

namespace theatron::capture {

Clock steady_clock() {
    return {steady_now, [](Duration time) { std::this_thread::sleep_for(time); }};
}

}  // namespace theatron::capture
