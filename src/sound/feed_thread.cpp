// SPDX-License-Identifier: Apache-2.0
#include "sound/feed_thread.h"

#define SDL_MAIN_HANDLED
#include <SDL.h>
#include <time.h>

#include <utility>

#include "base/fault.h"
#include "base/thread_name.h"

namespace theatron::sound {
namespace {

// Returns at this time of the steady clock, or before it where the semaphore is posted.
void wait(sem_t& semaphore, TimePoint until) {
    if (until == TimePoint::max()) {
        sem_wait(&semaphore);
        return;
    }
    constexpr std::int64_t second_us = 1'000'000;
    const timespec at{time_t(to_us(until) / second_us), long(to_us(until) % second_us) * 1000};
    sem_clockwait(&semaphore, CLOCK_MONOTONIC, &at);
}

}  // namespace

FeedThread::FeedThread(const char* name, std::function<TimePoint()> work) : work_(std::move(work)) {
    sem_init(&woken_, 0, 0);
    thread_ = std::thread([this, name] { run(name); });
}

FeedThread::~FeedThread() {
    ends_ = true;
    wake();
    thread_.join();
    sem_destroy(&woken_);
}

void FeedThread::run(const char* name) {
    name_this_thread(name);
    (void)SDL_SetThreadPriority(SDL_THREAD_PRIORITY_TIME_CRITICAL);
    TimePoint next = TimePoint::max();
    while (!ends_) {
        wait(woken_, next);
        if (ends_ || !contain("sound", [&] { next = work_(); }))
            next = TimePoint::max();
    }
}

}  // namespace theatron::sound
