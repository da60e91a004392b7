// SPDX-License-Identifier: Apache-2.0
#include "sound/device_watch.h"

#include <gtest/gtest.h>

#include <atomic>

namespace theatron::sound {
namespace {

TEST(DeviceWatch, FollowsDevicesThatComeAndGo) {
    std::atomic<bool> plugged = false;
    const DeviceWatch watch(
        [&] {
            DeviceList list;
            if (plugged)
                list.microphones = {"Headset"};
            return list;
        },
        std::chrono::milliseconds(1));
    const auto has_headset = [&] { return !watch.devices_now().microphones.empty(); };
    EXPECT_FALSE(has_headset());
    for (const bool now : {true, false}) {
        plugged = now;
        while (has_headset() != now)
            std::this_thread::yield();
    }
}

}  // namespace
}  // namespace theatron::sound
