// SPDX-License-Identifier: Apache-2.0
// The hand-over between two threads when only the newest value counts.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

namespace theatron {

// Holds at most one value. put() replaces an untaken one; take() waits.
template <class T>
class NewestSlot {
public:
    // Returns true if an untaken value was replaced, that is, dropped.
    bool put(T value) {
        bool replaced;
        {
            const std::lock_guard lock(mutex_);
            replaced = value_.has_value();
            value_ = std::move(value);
        }
        changed_.notify_one();
        return replaced;
    }

    // Waits at most `timeout` for a value. Empty after close() or in vain.
    template <class D>
    std::optional<T> take(D timeout) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, timeout, [&] { return value_ || closed_ || woken_; });
        woken_ = false;
        return std::exchange(value_, std::nullopt);
    }

    // Makes a waiting take() return at once, empty-handed if nothing is there.
    void wake() {
        {
            const std::lock_guard lock(mutex_);
            woken_ = true;
        }
        changed_.notify_all();
    }

    void close() {
        {
            const std::lock_guard lock(mutex_);
            closed_ = true;
        }
        changed_.notify_all();
    }
    bool closed() const {
        const std::lock_guard lock(mutex_);
        return closed_;
    }

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<T> value_;
    bool closed_ = false;
    bool woken_ = false;
};

}  // namespace theatron
