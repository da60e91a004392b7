// SPDX-License-Identifier: Apache-2.0
#include "sound/kept_device.h"

#include <utility>

#include "base/error.h"
#include "base/fault.h"
#include "base/thread_name.h"

namespace theatron::sound {

KeptDevice::KeptDevice(std::string kind, const std::string& name, Open open,
                       std::function<void(const std::string&)> say, Duration interval)
    : kind_(std::move(kind)),
      open_(std::move(open)),
      say_(std::move(say)),
      interval_(interval),
      name_(name) {
    {
        const std::lock_guard lock(mutex_);
        (void)open_now(true);
    }
    thread_ = std::thread([this] {
        name_this_thread("devices");
        std::unique_lock lock(mutex_);
        while (!ends_changed_.wait_for(lock, interval_, [this] { return ends_; }))
            (void)contain("devices", [this] { look(); });
    });
}

KeptDevice::~KeptDevice() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    ends_changed_.notify_all();
    thread_.join();
}

bool KeptDevice::open_now(bool is_first) {
    try {
        device_ = open_(name_);
        return true;
    } catch (const Error& error) {
        if (is_first)
            say_(error.what());
        return false;
    }
}

void KeptDevice::look() {
    if (device_ && !device_->works()) {
        device_.reset();
        say_("The " + kind_ + " '" + name_ +
             "' is gone; it is used again as soon as it is plugged in.");
    } else if (!device_ && !is_file(name_) && open_now(false)) {
        say_("The " + kind_ + " '" + name_ + "' is there.");
    }
}

bool KeptDevice::works() const {
    const std::lock_guard lock(mutex_);
    return device_ != nullptr;
}

std::optional<TimePoint> KeptDevice::began() const {
    const std::lock_guard lock(mutex_);
    return device_ ? device_->began() : std::nullopt;
}

std::string KeptDevice::name() const {
    const std::lock_guard lock(mutex_);
    return name_;
}

bool KeptDevice::change(const std::string& name) {
    const std::lock_guard lock(mutex_);
    // Some systems give a device to one user only.
    device_.reset();
    name_ = name;
    return open_now(true);
}

}  // namespace theatron::sound
