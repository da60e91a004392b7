// SPDX-License-Identifier: Apache-2.0
// A thread beside a sound device, with the priority that SDL gives to the device's own: it does
// what takes too long, or may wait, for the callback.
#pragma once

#include <semaphore.h>

#include <atomic>
#include <functional>
#include <thread>

#include "base/time.h"

namespace theatron::sound {

class FeedThread {
public:
    // `work` is called after each wake(), and at the time of steady_now() that it returned last;
    // the largest one: not before the next wake(). Its exceptions are logged.
    FeedThread(const char* name, std::function<TimePoint()> work);
    // Waits for the end of a call.
    ~FeedThread();
    FeedThread(const FeedThread&) = delete;
    FeedThread& operator=(const FeedThread&) = delete;

    // From any thread; waits for nothing, takes no lock and allocates nothing.
    void wake() noexcept { sem_post(&woken_); }

private:
    void run(const char* name);

    const std::function<TimePoint()> work_;
    std::atomic<bool> ends_ = false;
    sem_t woken_;
    std::thread thread_;
};

}  // namespace theatron::sound
