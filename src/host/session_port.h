// SPDX-License-Identifier: Apache-2.0
// A session's share of its host's port: the functions of net::Server, for the connections of this
// session, from begin() to leave().
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "host/host_port.h"

namespace theatron::host {

class SessionPort {
public:
    // `port` outlives this.
    SessionPort(HostPort& port, PortSession session);
    // It has left.
    ~SessionPort() = default;
    SessionPort(const SessionPort&) = delete;
    SessionPort& operator=(const SessionPort&) = delete;

    // Used by the owner of the session.
    // Lets connections come, then does the work that was posted so far. Throws Error if the last
    // other session has already left the port.
    void begin();
    bool has_begun() const;
    // No function of the session, and no posted work, is called from now on. Its connections end;
    // with the last session, those of the whole port. Not on the server's thread.
    void leave();

    // From any thread. Work that was posted before begin() waits for it.
    void post(std::function<void()> work);

    // As in net::Server, on the server's thread.
    void set_alarm(TimePoint when) { port_.sessions_.set_alarm(number_, when); }
    void send_control(net::PeerId peer, ByteView control) { server().send_control(peer, control); }
    void send_states(net::PeerId peer, std::span<const wire::State> states) {
        server().send_states(peer, states);
    }
    void send_voice(net::PeerId peer, const wire::Voice& voice) {
        server().send_voice(peer, voice);
    }
    net::Outbox::Pushed send_media(net::PeerId peer, net::Media media) {
        return server().send_media(peer, std::move(media));
    }
    void send_content(net::PeerId peer, net::Outbox::Content content) {
        server().send_content(peer, std::move(content));
    }
    void take_media(net::PeerId peer, std::size_t max_message) {
        server().take_media(peer, max_message);
    }
    void set_ceiling(net::PeerId peer, double bytes_per_second) {
        server().set_ceiling(peer, bytes_per_second);
    }
    void set_delay(net::PeerId peer, Duration delay) { server().set_delay(peer, delay); }
    void keep_everything(net::PeerId peer) { server().keep_everything(peer); }
    net::SendingFigures take_figures(net::PeerId peer) { return server().take_figures(peer); }
    bool is_behind(net::PeerId peer, StreamId stream) const {
        return server().is_behind(peer, stream);
    }
    void close(net::PeerId peer, const std::string& why) { server().close(peer, why); }
    void drop(net::PeerId peer, const std::string& why) { server().drop(peer, why); }

private:
    // Shared with posted work, which may outlive this object.
    struct Share {
        std::mutex mutex;
        bool has_begun = false;                      // guarded by mutex, as is the next
        std::vector<std::function<void()>> waiting;  // for begin()
        bool has_left = false;                       // server's thread
    };
    net::Server& server() const { return *port_.server_; }
    void send_there(std::function<void()> work);

    HostPort& port_;
    const std::string name_in_log_;
    PortSession session_;  // until begin()
    SessionNumber number_{};
    const std::shared_ptr<Share> share_ = std::make_shared<Share>();
};

}  // namespace theatron::host
