// SPDX-License-Identifier: Apache-2.0
#include "sound/device_watch.h"

#include <optional>
#include <utility>

#include "base/fault.h"

namespace theatron::sound {

DeviceWatch::DeviceWatch(std::function<DeviceList()> ask, Duration interval)
    : ask_(std::move(ask)), interval_(interval), thread_([this] { look(); }) {}

DeviceWatch::~DeviceWatch() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    ends_changed_.notify_all();
    thread_.join();
}

DeviceList DeviceWatch::devices_now() const {
    const std::lock_guard lock(mutex_);
    return devices_;
}

void DeviceWatch::look() {
    for (;;) {
        std::optional<DeviceList> devices;
        (void)contain("devices", [&] { devices = ask_(); });
        std::unique_lock lock(mutex_);
        if (devices)
            devices_ = std::move(*devices);
        if (ends_changed_.wait_for(lock, interval_, [this] { return ends_; }))
            return;
    }
}

}  // namespace theatron::sound
