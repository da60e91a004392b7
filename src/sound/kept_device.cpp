// SPDX-License-Identifier: Apache-2.0
#include "sound/kept_device.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/fault.h"
#include "base/thread_name.h"

namespace theatron::sound {
namespace {

constexpr const char* usual_device = "default";

}  // namespace

KeptDevice::KeptDevice(std::string kind, const std::string& name, Open open,
                       std::function<void(const std::string&)> say, Duration interval,
                       bool usual_instead)
    : kind_(std::move(kind)),
      open_(std::move(open)),
      say_(std::move(say)),
      interval_(interval),
      name_(name),
      usual_instead_(usual_instead) {
    {
        const std::lock_guard lock(mutex_);
        look();
    }
    thread_ = std::thread([this] {
        name_this_thread("devices");
        std::unique_lock lock(mutex_);
        const auto next = [this] {
            return device_ && device_->is_opening() ? std::min(answer_interval, interval_)
                                                    : interval_;
        };
        while (!changed_.wait_for(lock, next(), [this] { return ends_; }))
            (void)contain("devices", [this] { look(); });
    });
}

KeptDevice::~KeptDevice() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void KeptDevice::open_now() {
    was_used_ = false;
    try {
        device_ = open_(name_);
    } catch (const Error& error) {
        note_failure(error.what());
    }
}

// The next turn tries again.
void KeptDevice::note_failure(const std::string& problem) {
    device_.reset();
    if (!std::exchange(is_first_try_, false))
        return;
    if (!usual_instead_ || name_ == usual_device || is_file(name_))
        return say_(problem);
    say_("The " + kind_ + " '" + name_ +
         "' is not plugged in: the usual one is used (choose another one with P).");
    name_ = usual_device;
    is_first_try_ = true;
}

void KeptDevice::look() {
    if (!device_ && (!is_file(name_) || is_first_try_))
        open_now();
    if (!device_ || device_->is_opening())
        return;
    if (device_->works()) {
        if (!std::exchange(was_used_, true) && !std::exchange(is_first_try_, false))
            say_("The " + kind_ + " '" + name_ + "' is there.");
    } else if (was_used_) {
        device_.reset();
        say_("The " + kind_ + " '" + name_ +
             "' is gone; it is used again as soon as it is plugged in.");
    } else {
        note_failure(device_->problem());
    }
}

bool KeptDevice::works() const {
    const std::lock_guard lock(mutex_);
    return device_ && was_used_;
}

std::optional<TimePoint> KeptDevice::began() const {
    const std::lock_guard lock(mutex_);
    return device_ ? device_->began() : std::nullopt;
}

std::string KeptDevice::name() const {
    const std::lock_guard lock(mutex_);
    return name_;
}

void KeptDevice::change(const std::string& name) {
    {
        const std::lock_guard lock(mutex_);
        // Some systems give a device to one user only.
        device_.reset();
        name_ = name;
        usual_instead_ = false;
        is_first_try_ = true;
        look();
    }
    changed_.notify_all();
}

}  // namespace theatron::sound
