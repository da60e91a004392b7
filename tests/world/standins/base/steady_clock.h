// SPDX-License-Identifier: Apache-2.0
// The steady clock of what is compiled for the World: its time passes with the World's events.
// Names have a namespace of their own, since what is not compiled for it has the real clock.
#pragma once

#include "base/time.h"
#include "world/schedule.h"

namespace theatron {
inline namespace world_time {

inline TimePoint steady_now() {
    return world::Schedule::instance().now();
}

}  // namespace world_time
}  // namespace theatron
