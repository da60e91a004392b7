// SPDX-License-Identifier: Apache-2.0
#include "cli/service_notice.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <thread>

#include "testing/temporary_folder.h"

namespace theatron::cli {
namespace {

constexpr TimePoint begin = from_us(1'000'000'000);

// The manager's end of the socket.
class NoticeManager {
public:
    explicit NoticeManager(const std::string& path) {
        socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
        sockaddr_un own{};
        own.sun_family = AF_UNIX;
        std::strncpy(own.sun_path, path.c_str(), sizeof(own.sun_path) - 1);
        if (own.sun_path[0] == '@')
            own.sun_path[0] = '\0';
        const auto length = socklen_t(offsetof(sockaddr_un, sun_path) + path.size());
        EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&own), length), 0);
    }
    ~NoticeManager() { close(socket_); }
    // The next message; empty: there is none.
    std::string take() const {
        char text[200];
        const ssize_t size = recv(socket_, text, sizeof(text), 0);
        return size < 0 ? "" : std::string(text, std::size_t(size));
    }

private:
    int socket_ = -1;
};

TEST(ServiceNotice, TellsTheManagerOnceEach) {
    const testing::TemporaryFolder folder;
    const std::string path = folder.path() / "notify";
    const NoticeManager manager(path);
    ServiceNotice notice(path.c_str(), std::nullopt);
    notice.ready("Two sessions");
    EXPECT_EQ(manager.take(), "READY=1\nSTATUS=Two sessions");
    notice.status("Three sessions");
    EXPECT_EQ(manager.take(), "STATUS=Three sessions");
    notice.reloading(begin);
    EXPECT_EQ(manager.take(), "RELOADING=1\nMONOTONIC_USEC=1000000000");
    notice.stopping();
    EXPECT_EQ(manager.take(), "STOPPING=1");
    // No watchdog waits.
    notice.alive(begin);
    EXPECT_EQ(manager.take(), "");
}

TEST(ServiceNotice, IsHeardOnAnAbstractSocketToo) {
    const std::string name = "@theatron_notice_test_" + std::to_string(getpid());
    const NoticeManager manager(name);
    ServiceNotice(name.c_str(), std::nullopt).stopping();
    EXPECT_EQ(manager.take(), "STOPPING=1");
}

TEST(ServiceNotice, SaysTwiceInTheWatchdogsTimeThatAllIsWell) {
    const testing::TemporaryFolder folder;
    const std::string path = folder.path() / "notify";
    const NoticeManager manager(path);
    ServiceNotice notice(path.c_str(), watchdog_interval("10000000", nullptr, 1));
    notice.alive(begin);
    EXPECT_EQ(manager.take(), "WATCHDOG=1");
    notice.alive(begin + std::chrono::milliseconds(4999));
    EXPECT_EQ(manager.take(), "");
    notice.alive(begin + std::chrono::seconds(5));
    EXPECT_EQ(manager.take(), "WATCHDOG=1");
}

TEST(ServiceNotice, ABusyManagerStillHearsOfTheEnd) {
    const testing::TemporaryFolder folder;
    const std::string path = folder.path() / "notify";
    const NoticeManager manager(path);
    ServiceNotice notice(path.c_str(), watchdog_interval("2", nullptr, 1));
    // More than any queue of datagrams holds, and none of them waits for room.
    for (int i = 0; i < 2000; ++i)
        notice.alive(begin + std::chrono::milliseconds(i));
    std::string last;
    std::atomic<bool> is_told{false};
    std::thread reader([&] {
        for (bool is_last = false; !is_last;) {
            is_last = is_told;
            for (std::string next = manager.take(); !next.empty(); next = manager.take())
                last = next;
        }
    });
    notice.stopping();
    is_told = true;
    reader.join();
    EXPECT_EQ(last, "STOPPING=1");
}

TEST(ServiceNotice, WithoutAManagerNothingHappens) {
    EXPECT_FALSE(ServiceNotice(nullptr, std::nullopt).has_manager());
    ServiceNotice(nullptr, std::nullopt).stopping();
    ServiceNotice("/nonexistent/notify", std::nullopt).ready("");
    ServiceNotice("relative", std::nullopt).ready("");
    ServiceNotice(std::string(300, '/').c_str(), std::nullopt).ready("");
}

TEST(ServiceNotice, TheWatchdogOfAnotherProcessIsNotAnswered) {
    EXPECT_EQ(watchdog_interval("10000000", "17", 17), Duration(std::chrono::seconds(5)));
    EXPECT_EQ(watchdog_interval("10000000", "18", 17), std::nullopt);
    EXPECT_EQ(watchdog_interval(nullptr, nullptr, 17), std::nullopt);
    for (const char* wrong : {"", "x", "1s", "0", "-5", "99999999999999999999"})
        EXPECT_EQ(watchdog_interval(wrong, nullptr, 17), std::nullopt) << wrong;
}

}  // namespace
}  // namespace theatron::cli
