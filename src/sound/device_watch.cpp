// SPDX-License-Identifier: Apache-2.0
#include "sound/device_watch.h"

#include <mutex>
#include <utility>

namespace theatron::sound {

// Kept by a question that is not answered, too.
struct DeviceWatch::Answers {
    std::mutex mutex;
    DeviceList newest;
    bool is_asked = false;
};

DeviceWatch::DeviceWatch(Ask ask, Duration interval)
    : ask_(std::move(ask)), interval_(interval), answers_(std::make_shared<Answers>()) {}

DeviceList DeviceWatch::devices_at(TimePoint now) {
    std::unique_lock lock(answers_->mutex);
    if (now >= next_ && !std::exchange(answers_->is_asked, true)) {
        next_ = now + interval_;
        lock.unlock();
        ask_([answers = answers_](DeviceList found) {
            const std::lock_guard answer_lock(answers->mutex);
            answers->newest = std::move(found);
            answers->is_asked = false;
        });
        lock.lock();
    }
    return answers_->newest;
}

}  // namespace theatron::sound
