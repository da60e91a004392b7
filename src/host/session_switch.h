// SPDX-License-Identifier: Apache-2.0
// Leads each connection of a port to the session whose token it has shown, and shares the port's
// alarm among the sessions. It has no socket, thread or clock of its own.
//
// All functions on the server's thread, or before that thread runs, unless stated.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/closed_session.h"
#include "host/port_places.h"
#include "host/port_session.h"

namespace theatron::host {

class SessionSwitch {
public:
    // `set_alarm`: asks for a call of alarm() at this time instead of the time before.
    // `turn_back`: closes a connection without a word, so that its program tries again.
    SessionSwitch(std::function<void(TimePoint)> set_alarm,
                  std::function<void(net::PeerId)> turn_back)
        : set_server_alarm_(std::move(set_alarm)), turn_back_(std::move(turn_back)) {}

    SessionNumber add(PortSession session);
    // Returns its connections. Their events, and calls of the session, go nowhere from now on.
    std::vector<net::PeerId> remove(SessionNumber number);

    // True if a connection with this first message finds a place; see PortPlaces.
    bool has_place(ByteView first) const;
    // The events of connections. One that has shown no session's token comes to the oldest session,
    // which says why it refuses. A session that throws costs the connection alone.
    void connected(net::PeerId peer, const std::string& address, bool invited);
    void control(net::PeerId peer, ByteView message);
    void state(net::PeerId peer, const wire::State& state);
    void voice(net::PeerId peer, const wire::Voice& voice);
    void frame_left(net::PeerId peer);
    void control_lost(net::PeerId peer);
    bool media(net::PeerId peer, Bytes& message);
    void closed(net::PeerId peer, const std::string& why);

    // For all sessions. A fault of one is contained: the others go on.
    void tick();
    // Calls alarm() of this session at `when` instead of the time that it set before.
    void set_alarm(SessionNumber number, TimePoint when);
    void alarm(TimePoint now);

    // From any thread: the sessions that are not open now, but will be. Those who show a token of
    // one are turned back.
    void set_closed(std::vector<ClosedSession> closed);
    std::vector<ClosedSession> closed() const;
    bool is_closed(const std::string& secret) const;

    // From any thread: true if a connection's first message shows a token of any session, open or
    // not.
    bool is_invited(ByteView first) const;
    // From any thread: calls `look` with all sessions, the oldest first, which stay until it
    // returns.
    using Sessions = std::vector<std::pair<SessionNumber, PortSession>>;
    template <class Look>
    auto look(Look look) const {
        const std::lock_guard lock(mutex_);
        return look(sessions_);
    }

private:
    struct Entering {
        std::string address;
        bool invited = false;
    };
    // That a connection claims by its first message.
    struct Claim {
        std::optional<SessionNumber> session;  // whose token it shows
        PortPlaces::Kind kind = PortPlaces::Kind::other;
    };
    const PortSession* find(net::PeerId peer) const;
    const PortSession* find(SessionNumber number) const;
    Claim claim_of(ByteView first) const;
    void arm();

    const std::function<void(TimePoint)> set_server_alarm_;
    const std::function<void(net::PeerId)> turn_back_;
    // Changed on the server's thread; other threads read it, with the mutex.
    mutable std::mutex mutex_;
    Sessions sessions_;
    mutable std::mutex closed_mutex_;
    std::vector<ClosedSession> closed_;  // guarded by closed_mutex_
    std::uint32_t next_ = 1;
    std::map<net::PeerId, Entering> entering_;  // whose first message is still to come
    std::map<net::PeerId, SessionNumber> peers_;
    PortPlaces places_;
    std::map<SessionNumber, TimePoint> alarms_;
    std::optional<TimePoint> armed_;
};

}  // namespace theatron::host
