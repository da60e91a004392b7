// SPDX-License-Identifier: Apache-2.0
// Tells the manager of a service (systemd) that this process is ready, alive or ending, by the
// protocol of sd_notify(3): a datagram to the socket that $NOTIFY_SOCKET names.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "base/time.h"

namespace theatron::cli {

// How often a manager that waits for $WATCHDOG_USEC microseconds wants to hear something: twice in
// that time. nullopt: it does not wait, or for another process (`pid` is $WATCHDOG_PID). Both may
// be null, as an environment's variables may.
std::optional<Duration> watchdog_interval(const char* microseconds, const char* pid, pid_t own);

// One thread. A manager that is busy is waited for a second at most, with alive() not at all, and
// its absence is no problem.
class ServiceNotice {
public:
    // `socket`: a path, or @NAME of an abstract one; null or another text: nobody is told.
    ServiceNotice(const char* socket, std::optional<Duration> watchdog);
    // As the environment says, whose variables are removed: programs that this one starts do not
    // speak for it.
    static ServiceNotice of_environment();
    ~ServiceNotice();
    ServiceNotice(ServiceNotice&&) noexcept;
    ServiceNotice(const ServiceNotice&) = delete;
    ServiceNotice& operator=(const ServiceNotice&) = delete;

    // True if somebody is told.
    bool has_manager() const { return socket_ >= 0; }
    void ready(const std::string& status);
    void status(const std::string& status);  // what people are shown, once ready
    void reloading(TimePoint now);
    void stopping();
    // Call it often; it says that all is well when that is due.
    void alive(TimePoint now);

private:
    void send(const std::string& message, int flags = 0) const;

    std::string address_;
    int socket_ = -1;
    std::optional<Duration> watchdog_;
    std::optional<TimePoint> told_alive_;
};

}  // namespace theatron::cli
