// SPDX-License-Identifier: Apache-2.0
// Threads for work that nothing waits for and that must slow nothing down: at a lower priority
// than the rest of the process, and not more of them than half of the cores.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace theatron::send {

class Background {
public:
    // As many threads as that; they begin with the first work.
    explicit Background(int threads);
    // Work that has not begun is dropped; its owner no longer waits for it.
    ~Background();

    // From any thread: does `work` later, first come first served. It throws nothing.
    void enqueue(std::function<void()> work);

private:
    void run();

    const int thread_count_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> waiting_;
    bool stopping_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace theatron::send
