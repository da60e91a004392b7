// SPDX-License-Identifier: Apache-2.0
#include "cli/service_notice.h"

#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

namespace theatron::cli {
namespace {

// A manager that reads nothing for so long does without the message.
constexpr timeval patience{.tv_sec = 1, .tv_usec = 0};

std::optional<std::int64_t> number_of(const char* text) {
    if (!text)
        return std::nullopt;
    std::int64_t number = 0;
    const char* const end = text + std::strlen(text);
    const auto [at, error] = std::from_chars(text, end, number);
    if (error != std::errc() || at != end)
        return std::nullopt;
    return number;
}

}  // namespace

std::optional<Duration> watchdog_interval(const char* microseconds, const char* pid, pid_t own) {
    const auto time = number_of(microseconds);
    if (!time || *time <= 0 || (pid && number_of(pid) != own))
        return std::nullopt;
    return std::chrono::microseconds(*time) / 2;
}

ServiceNotice::ServiceNotice(const char* socket, std::optional<Duration> watchdog)
    : address_(socket ? socket : ""), watchdog_(watchdog) {
    const bool is_address = address_.starts_with('/') || address_.starts_with('@');
    if (!is_address || address_.size() >= sizeof(sockaddr_un::sun_path))
        return;
    // The first byte of an abstract name is 0.
    if (address_.front() == '@')
        address_.front() = '\0';
    socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (socket_ >= 0)
        setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof(patience));
}

ServiceNotice ServiceNotice::of_environment() {
    ServiceNotice notice(
        std::getenv("NOTIFY_SOCKET"),
        watchdog_interval(std::getenv("WATCHDOG_USEC"), std::getenv("WATCHDOG_PID"), getpid()));
    for (const char* variable : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"})
        unsetenv(variable);
    return notice;
}

ServiceNotice::ServiceNotice(ServiceNotice&& other) noexcept
    : address_(std::move(other.address_)),
      socket_(std::exchange(other.socket_, -1)),
      watchdog_(other.watchdog_),
      told_alive_(other.told_alive_) {}

ServiceNotice::~ServiceNotice() {
    if (socket_ >= 0)
        close(socket_);
}

void ServiceNotice::ready(const std::string& status) {
    send("READY=1\nSTATUS=" + status);
}

void ServiceNotice::status(const std::string& status) {
    send("STATUS=" + status);
}

void ServiceNotice::reloading(TimePoint now) {
    const auto time = std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch());
    send("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(time.count()));
}

void ServiceNotice::stopping() {
    send("STOPPING=1");
}

void ServiceNotice::alive(TimePoint now) {
    if (!watchdog_ || (told_alive_ && now - *told_alive_ < *watchdog_))
        return;
    told_alive_ = now;
    // The next one comes soon, and what the program does must not wait for it.
    send("WATCHDOG=1", MSG_DONTWAIT);
}

void ServiceNotice::send(const std::string& message, int flags) const {
    if (socket_ < 0)
        return;
    sockaddr_un to{};
    to.sun_family = AF_UNIX;
    std::copy(address_.begin(), address_.end(), to.sun_path);
    const auto length = socklen_t(offsetof(sockaddr_un, sun_path) + address_.size());
    (void)sendto(socket_, message.data(), message.size(), MSG_NOSIGNAL | flags,
                 reinterpret_cast<const sockaddr*>(&to), length);
}

}  // namespace theatron::cli
