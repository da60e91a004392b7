// SPDX-License-Identifier: Apache-2.0
// A few threads that do pieces of work, first come first served.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace theatron::send {

class ThreadPool {
public:
    // The threads begin with the first work. They get `name`, at most 15 characters, and run
    // `added_niceness` below the priority of the process where the system allows it.
    ThreadPool(const char* name, int threads, int added_niceness = 0);
    // Work that has not begun is dropped; its owner no longer waits for it.
    ~ThreadPool();

    // From any thread. Does `work` later, after all that waits or before it. An exception of
    // `work` is logged and goes no further.
    void enqueue(std::function<void()> work);
    void enqueue_first(std::function<void()> work);

    // True if a thread has nothing to do and nothing waits for one.
    bool has_idle_thread() const { return idle_ > waiting_count_; }

private:
    void put(std::function<void()> work, bool first);
    void run();

    const char* const name_;
    const int thread_count_;
    const int added_niceness_;
    std::mutex mutex_;
    std::condition_variable changed_;
    // Short, so taking from its front is cheap; it keeps its memory.
    std::vector<std::function<void()>> waiting_;
    bool stopping_ = false;
    std::vector<std::thread> threads_;
    std::atomic<int> idle_{0}, waiting_count_{0};  // changed only with `mutex_` locked
};

}  // namespace theatron::send
