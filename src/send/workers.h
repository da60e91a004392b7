// SPDX-License-Identifier: Apache-2.0
// The threads that do the work of all cameras: as many as there are cores,
// however many cameras there are, and one thread for periodic calls.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <thread>

#include "base/time.h"
#include "send/thread_pool.h"

namespace theatron::send {

class Workers {
public:
    // 0: one thread per core.
    explicit Workers(int threads = 0);
    ~Workers();  // owners of work must have waited for it before

    int threads() const { return threads_; }

    // From any thread. All but the last: an exception of `work` is noted and goes no further.

    // Does `work` soon, first come first served. It must not wait for other work.
    void enqueue(std::function<void()> work) { pool_.enqueue(std::move(work)); }
    // Does `work` before all other work that waits. For work that completes a frame.
    void enqueue_first(std::function<void()> work) { pool_.enqueue_first(std::move(work)); }
    // Does `work` later, on background threads: half as many as the others, and of lower
    // priority.
    void enqueue_behind(std::function<void()> work) { background_.enqueue(std::move(work)); }
    // True if work that is enqueued now begins at once.
    bool has_idle_thread() const { return pool_.has_idle_thread(); }

    // Calls `look` every 20 ms, on a thread of its own, until forget() has returned. An exception
    // of it is logged; the other calls go on.
    static constexpr Duration look_every = 20ms;
    using Ticket = std::uint64_t;
    Ticket look_after(std::function<void()> look);
    void forget(Ticket ticket);

private:
    void look_around();

    // A tenth of the weight of the other threads: background work still progresses on a machine
    // that is fully used.
    static constexpr int background_niceness = 10;

    const int threads_;
    ThreadPool pool_;
    ThreadPool background_;

    std::mutex mutex_;  // guards all below; locked during the periodic calls
    std::condition_variable changed_;
    std::map<Ticket, std::function<void()>> looks_;
    Ticket next_ticket_ = 1;
    bool stopping_ = false;
    std::thread looking_;
};

}  // namespace theatron::send
