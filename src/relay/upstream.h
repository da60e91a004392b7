// SPDX-License-Identifier: Apache-2.0
// A relay's connection to the host, made again when it breaks.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/time.h"
#include "client/attempts.h"
#include "net/client.h"
#include "net/clock_sync.h"
#include "net/link.h"
#include "session/viewer_session.h"
#include "wire/control.h"
#include "wire/media_header.h"

namespace theatron::relay {

class Upstream {
public:
    // From the connection's own thread.
    struct Events {
        // All receivers from now on; none while the host is not there.
        std::function<void(std::vector<wire::RelayReceiver>)> receivers;
        std::function<void(const wire::MediaHeader&, std::shared_ptr<const Bytes>)> media;
        // A line for the person: lost, there again, refused.
        std::function<void(const std::string&)> remark;
    };
    enum class Phase : std::uint8_t { connecting, joined, lost, refused, ended };
    struct Status {
        Phase phase = Phase::connecting;
        std::string problem;  // why lost, refused or ended
        std::string host_name;
        int joins = 0;
    };

    // Throws Error if the link's token or the name do not fit into the first message.
    Upstream(net::Link link, const std::string& name, wire::OfferRelay offer, Events events);
    ~Upstream();

    Status status() const;
    // Session time; before it is known, this machine's steady clock.
    TimePoint now() const;
    // From any thread; left out while the host is not there.
    void report(wire::RelayReport report);

private:
    void run();
    net::Client::Handler handler();
    void on_control(ByteView message);
    void on_tick();
    // The time until another attempt; nullopt: there is none.
    std::optional<Duration> end(const net::Client::End& end);

    const net::Link link_;
    const wire::OfferRelay offer_;
    const Events events_;
    // The connection's thread.
    session::ViewerSession session_;
    client::Attempts attempts_;
    net::ClockSync clock_;
    TimePoint next_ping_;
    int pings_ = 0, pongs_ = 0;

    std::atomic<std::int64_t> offset_us_ = 0;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    bool stopping_ = false;          // guarded by mutex_, as are the next
    net::Client* client_ = nullptr;  // while one runs
    Status status_;
    std::thread thread_;
};

const char* text_of(Upstream::Phase phase);

}  // namespace theatron::relay
