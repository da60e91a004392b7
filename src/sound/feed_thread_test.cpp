// SPDX-License-Identifier: Apache-2.0
#include "sound/feed_thread.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "base/fault.h"
#include "testing/wait_until.h"

namespace theatron::sound {
namespace {

TEST(FeedThread, WorksWhenItIsWokenAndWhenItsTimeHasCome) {
    std::atomic<int> calls = 0, still_to_come = 0;
    FeedThread thread("test", [&] {
        ++calls;
        // A time that has passed: again at once.
        return still_to_come-- > 0 ? TimePoint{} : TimePoint::max();
    });
    thread.wake();
    testing::wait_until([&] { return calls == 1; });
    still_to_come = 5;
    thread.wake();
    testing::wait_until([&] { return calls == 7; });
}

TEST(FeedThread, AFaultCostsOneCall) {
    std::atomic<int> calls = 0;
    const std::uint64_t before = fault_count();
    FeedThread thread("test", [&]() -> TimePoint {
        if (++calls == 1)
            throw std::runtime_error("a fault");
        return TimePoint::max();
    });
    thread.wake();
    testing::wait_until([&] { return fault_count() == before + 1; });
    thread.wake();
    testing::wait_until([&] { return calls == 2; });
}

TEST(FeedThread, EndsWithoutACall) {
    std::atomic<int> calls = 0;
    {
        const FeedThread thread("test", [&] { return ++calls, TimePoint::max(); });
    }
    EXPECT_EQ(calls, 0);
}

}  // namespace
}  // namespace theatron::sound
