// SPDX-License-Identifier: Apache-2.0
#include "send/background.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#include "base/thread_name.h"

namespace theatron::send {
namespace {

// Beyond the process's own. With a tenth of the weight of the other threads it still gets somewhere
// on a machine that is fully used.
constexpr int added_niceness = 10, highest_niceness = 19;

}  // namespace

Background::Background(int threads) : thread_count_(threads) {}

Background::~Background() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        waiting_.clear();
    }
    changed_.notify_all();
    for (std::thread& thread : threads_)
        thread.join();
}

void Background::enqueue(std::function<void()> work) {
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(work));
        if (threads_.empty())
            for (int i = 0; i < thread_count_; ++i)
                threads_.emplace_back([this] { run(); });
    }
    changed_.notify_one();
}

void Background::run() {
    name_this_thread("behind");
    // Of this thread alone; where it is not possible, the number of threads still bounds the work.
    const int niceness = getpriority(PRIO_PROCESS, id_t(getpid())) + added_niceness;
    (void)setpriority(PRIO_PROCESS, id_t(gettid()), std::min(niceness, highest_niceness));
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return stopping_ || !waiting_.empty(); });
        if (stopping_)
            return;
        const auto work = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        work();
        lock.lock();
    }
}

}  // namespace theatron::send
