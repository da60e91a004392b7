// SPDX-License-Identifier: Apache-2.0
#include "host/session_port.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <optional>
#include <stdexcept>

#include "base/error.h"
#include "testing/temporary_folder.h"

namespace theatron::host {
namespace {

class PortOfTwo : public ::testing::Test {
protected:
    PortOfTwo() {
        port.require_free();
        port.open_certificates(folder.path());
        port.open_page();
        port.open();
    }
    static PortOptions options() {
        PortOptions options;
        options.listen.address = "127.0.0.1";
        options.is_audited = false;
        return options;
    }
    // A session that counts its ticks.
    static PortSession session(std::atomic<int>& ticks) {
        PortSession session;
        session.events.tick = [&ticks] { ++ticks; };
        session.events.alarm = [] {};
        return session;
    }
    // Waits until all work that was posted before is done, or left out.
    static void settle(SessionPort& other) {
        std::promise<void> done;
        other.post([&] { done.set_value(); });
        done.get_future().wait();
    }
    static void wait_for_ticks(const std::atomic<int>& ticks, int more) {
        for (const int before = ticks; ticks < before + more;)
            std::this_thread::yield();
    }

    testing::TemporaryFolder folder;
    HostPort port{options()};
    std::atomic<int> first_ticks = 0, second_ticks = 0;
};

TEST_F(PortOfTwo, WorkThatWasPostedWaitsForTheBeginningAndIsDoneInOrder) {
    SessionPort first(port, session(first_ticks));
    std::string done;
    first.post([&] { done += "a"; });
    first.post([&] { done += "b"; });
    EXPECT_FALSE(first.has_begun());
    first.begin();
    EXPECT_TRUE(first.has_begun());
    first.post([&] { done += "c"; });
    settle(first);
    EXPECT_EQ(done, "abc");
    first.leave();
}

TEST_F(PortOfTwo, NothingOfASessionIsCalledAfterItHasLeftAndTheOtherGoesOn) {
    SessionPort first(port, session(first_ticks)), second(port, session(second_ticks));
    first.begin();
    second.begin();
    wait_for_ticks(first_ticks, 1);
    wait_for_ticks(second_ticks, 1);
    second.leave();
    const int left_at = second_ticks;
    bool is_called = false;
    second.post([&] { is_called = true; });
    settle(first);
    wait_for_ticks(first_ticks, 2);
    EXPECT_FALSE(is_called);
    EXPECT_EQ(second_ticks, left_at);
    first.leave();
}

TEST_F(PortOfTwo, WorkThatThrowsEndsNeitherSession) {
    SessionPort first(port, session(first_ticks)), second(port, session(second_ticks));
    first.begin();
    second.begin();
    second.post([] { throw std::runtime_error("fault"); });
    settle(second);
    wait_for_ticks(first_ticks, 1);
    wait_for_ticks(second_ticks, 1);
    second.leave();
    first.leave();
}

TEST_F(PortOfTwo, APortClosesWithItsLastSession) {
    SessionPort first(port, session(first_ticks)), late(port, session(second_ticks));
    first.begin();
    first.leave();
    EXPECT_THROW(late.begin(), Error);
    late.leave();  // as after a failed beginning
}

}  // namespace
}  // namespace theatron::host
