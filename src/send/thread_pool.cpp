// SPDX-License-Identifier: Apache-2.0
#include "send/thread_pool.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#include "base/fault.h"
#include "base/thread_name.h"

namespace theatron::send {
namespace {

constexpr int highest_niceness = 19;

}  // namespace

ThreadPool::ThreadPool(const char* name, int threads, int added_niceness)
    : name_(name), thread_count_(threads), added_niceness_(added_niceness) {}

ThreadPool::~ThreadPool() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        waiting_.clear();
    }
    changed_.notify_all();
    for (std::thread& thread : threads_)
        thread.join();
}

void ThreadPool::enqueue(std::function<void()> work) {
    put(std::move(work), false);
}

void ThreadPool::enqueue_first(std::function<void()> work) {
    put(std::move(work), true);
}

void ThreadPool::put(std::function<void()> work, bool first) {
    {
        const std::lock_guard lock(mutex_);
        waiting_.insert(first ? waiting_.begin() : waiting_.end(), std::move(work));
        ++waiting_count_;
        if (threads_.empty()) {
            idle_ = thread_count_;
            for (int i = 0; i < thread_count_; ++i)
                threads_.emplace_back([this] { run(); });
        }
    }
    changed_.notify_one();
}

void ThreadPool::run() {
    name_this_thread(name_);
    if (added_niceness_ > 0) {
        // On Linux this sets the priority of the calling thread only.
        const int niceness = getpriority(PRIO_PROCESS, id_t(getpid())) + added_niceness_;
        (void)setpriority(PRIO_PROCESS, id_t(gettid()), std::min(niceness, highest_niceness));
    }
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return stopping_ || !waiting_.empty(); });
        if (stopping_)
            return;
        auto work = std::move(waiting_.front());
        waiting_.erase(waiting_.begin());
        --waiting_count_;
        --idle_;
        lock.unlock();
        (void)contain("work", work);
        work = nullptr;  // its captures are not destroyed under the lock
        lock.lock();
        ++idle_;
    }
}

}  // namespace theatron::send
