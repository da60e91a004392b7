// SPDX-License-Identifier: Apache-2.0
// The threads that do the work of all cameras: as many as there are cores,
// however many cameras there are, and one that looks after time.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <thread>

// The library is not instrumented for the thread sanitizer, so what its headers do must not be
// either: half of what they do with their tasks would be seen.
#if defined(__clang__)
#pragma clang attribute push(__attribute__((no_sanitize("thread"))), apply_to = function)
#endif
#include <tbb/global_control.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>
#include <tbb/task_scheduler_observer.h>
#if defined(__clang__)
#pragma clang attribute pop
#endif

#include "base/fault.h"
#include "base/time.h"
#include "send/background.h"

namespace theatron::send {

class Workers {
public:
    // 0: one thread per core.
    explicit Workers(int threads = 0);
    ~Workers();  // what was begun is finished by its owner before

    int threads() const { return threads_; }

    // Does `work` soon, first come first served. It must not wait for other work. What it throws
    // is noted and goes no further.
    template <class Work>
    void enqueue(Work work) {
        ++waiting_;
        hand_over();
        arena_.enqueue([this, work = std::move(work)] {
            take_over();
            --waiting_;
            (void)contain("work", work);
        });
    }

    // Does `work` later, behind everything else, on threads of their own. It throws nothing.
    void enqueue_behind(std::function<void()> work) { background_.enqueue(std::move(work)); }

    // From within work: does both, on two threads if one is idle. Nothing else is
    // begun meanwhile, so that what is nearly done is done first. While other work
    // waits, one after the other: nobody then waits for another thread's half.
    template <class A, class B>
    void both(const A& a, const B& b) {
        if (waiting_ > 0) {
            a();
            b();
            return;
        }
        const auto half = [](const auto& work) {
            return [&work] {
                take_over();
                work();
                hand_over();
            };
        };
        hand_over();
        tbb::this_task_arena::isolate([&] { tbb::parallel_invoke(half(a), half(b)); });
        take_over();
    }

    // Calls `look` every 20 ms, on a thread of its own, until forget() has returned. What it
    // throws is noted and costs nobody else a look.
    static constexpr Duration look_every = 20ms;
    using Ticket = std::uint64_t;
    Ticket look_after(std::function<void()> look);
    void forget(Ticket ticket);

private:
    // Threads come into being when there is work, and take the name of who has it.
    struct Names final : tbb::task_scheduler_observer {
        explicit Names(tbb::task_arena& arena);
        ~Names() override;
        void on_scheduler_entry(bool is_worker) override;
    };

    void look_around();

    // The library orders what is done before work is passed to another thread ahead of that work.
    // The thread sanitizer does not see into the library, so it is said once more.
    static void hand_over() { passed_on_.fetch_add(1, std::memory_order_release); }
    static void take_over() { passed_on_.fetch_add(0, std::memory_order_acquire); }
    static inline std::atomic<unsigned> passed_on_{0};

    const int threads_;
    std::atomic<int> waiting_{0};
    // The library counts the calling thread, which does no work here.
    tbb::global_control limit_;
    tbb::task_arena arena_;
    Names names_{arena_};
    Background background_{std::max(1, threads_ / 2)};

    std::mutex mutex_;  // guards all below; held while somebody looks
    std::condition_variable changed_;
    std::map<Ticket, std::function<void()>> looks_;
    Ticket next_ticket_ = 1;
    bool stopping_ = false;
    std::thread looking_;
};

}  // namespace theatron::send
