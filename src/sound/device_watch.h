// SPDX-License-Identifier: Apache-2.0
// The sound devices of this machine, asked for on a thread of its own: the system may take long
// to answer.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "sound/sound_device.h"

namespace theatron::sound {

class DeviceWatch {
public:
    static constexpr Duration usual_interval = std::chrono::seconds(2);

    // `ask` is called at once and then again and again, until this object is destroyed.
    explicit DeviceWatch(std::function<DeviceList()> ask = devices,
                         Duration interval = usual_interval);
    ~DeviceWatch();

    // The newest answer; empty before the first one. From any thread.
    DeviceList devices_now() const;

private:
    void look();

    const std::function<DeviceList()> ask_;
    const Duration interval_;
    mutable std::mutex mutex_;
    std::condition_variable ends_changed_;
    DeviceList devices_;
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace theatron::sound
