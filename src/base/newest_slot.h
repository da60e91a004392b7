// SPDX-License-Identifier: Apache-2.0
// The hand-over between two threads when the newest values count.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace theatron {

// Holds at most `capacity` values, usually one. put() replaces the oldest
// untaken one if there is no room; take() waits.
template <class T>
class NewestSlot {
public:
    explicit NewestSlot(std::size_t capacity = 1) : capacity_(capacity) {}

    // Returns true if an untaken value was replaced, that is, dropped.
    bool put(T value) {
        bool replaced;
        {
            const std::lock_guard lock(mutex_);
            replaced = values_.size() == capacity_;
            if (replaced)
                values_.pop_front();
            values_.push_back(std::move(value));
        }
        changed_.notify_one();
        return replaced;
    }

    // Waits at most `timeout` for a value. Empty after close(), wake() or the timeout.
    template <class D>
    std::optional<T> take(D timeout) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, timeout, [&] { return !values_.empty() || closed_ || woken_; });
        woken_ = false;
        if (values_.empty())
            return std::nullopt;
        std::optional<T> oldest = std::move(values_.front());
        values_.pop_front();
        return oldest;
    }

    bool waiting() const { return size() > 0; }
    // Values that wait to be taken.
    std::size_t size() const {
        const std::lock_guard lock(mutex_);
        return values_.size();
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
    std::deque<T> values_;
    const std::size_t capacity_;
    bool closed_ = false;
    bool woken_ = false;
};

}  // namespace theatron
