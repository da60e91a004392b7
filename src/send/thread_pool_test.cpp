// SPDX-License-Identifier: Apache-2.0
#include "send/thread_pool.h"

#include <gtest/gtest.h>

#include <future>
#include <stdexcept>

namespace theatron::send {
namespace {

// Work that goes on until the test ends it.
class Gate {
public:
    std::function<void()> work() {
        return [this] {
            begun_.set_value();
            end_.get_future().wait();
        };
    }
    void wait_until_begun() { begun_.get_future().wait(); }
    void end() { end_.set_value(); }

private:
    std::promise<void> begun_, end_;
};

TEST(ThreadPool, DoesWorkInItsOrderAndUrgentWorkFirst) {
    std::vector<int> done;
    std::promise<void> last;
    Gate gate;
    ThreadPool pool("test", 1);
    pool.enqueue(gate.work());
    gate.wait_until_begun();
    pool.enqueue([&] { done.push_back(1); });
    pool.enqueue([&] {
        done.push_back(2);
        last.set_value();
    });
    pool.enqueue_first([&] { done.push_back(0); });
    gate.end();
    last.get_future().wait();
    EXPECT_EQ(done, (std::vector{0, 1, 2}));
}

TEST(ThreadPool, HasAnIdleThreadUntilAllAreBusyOrSpokenFor) {
    Gate first, second;
    ThreadPool pool("test", 2);
    pool.enqueue(first.work());
    first.wait_until_begun();
    EXPECT_TRUE(pool.has_idle_thread());
    pool.enqueue(second.work());
    EXPECT_FALSE(pool.has_idle_thread());
    second.wait_until_begun();
    EXPECT_FALSE(pool.has_idle_thread());
    first.end();
    second.end();
}

TEST(ThreadPool, OutlivesAnExceptionOfItsWork) {
    std::promise<void> done;
    ThreadPool pool("test", 1);
    pool.enqueue([] { throw std::runtime_error("a fault"); });
    pool.enqueue([&] { done.set_value(); });
    done.get_future().wait();
}

}  // namespace
}  // namespace theatron::send
