// SPDX-License-Identifier: Apache-2.0
// The host's side of the network: one TLS 1.3 port, one WebSocket per
// participant. It does not read the content of messages. Strangers are
// kept apart until they have shown the token (net/door.h).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "net/access.h"
#include "net/certificate.h"
#include "net/http.h"
#include "net/link.h"
#include "net/outbox.h"

namespace theatron::net {

// One accepted connection, numbered from 1.
enum class PeerId : std::uint32_t {};

// Throws Error, as Server does, if the address or port cannot be had now.
void require_free(const Endpoint& endpoint);

class Server {
public:
    // Connections that have shown the token; more than the session admits, so that it can say why
    // it refuses one.
    static constexpr std::size_t max_invited = 192;
    // Connections without the token that are still being refused; a new one closes the oldest.
    static constexpr std::size_t max_uninvited = 16;

    // Called on the thread that runs the server, unless said otherwise. A call that throws costs
    // the connection that it was made for.
    struct Handler {
        // On the door's thread, at the same time as the others: true if a connection's first
        // control message shows the token. Empty: all connections are invited.
        std::function<bool(ByteView first)> invited;
        // True if an invited connection, whose first message this is, finds a place; else it is
        // closed. Empty: each does, up to max_invited.
        std::function<bool(ByteView first)> has_place;
        // On the door's thread, too. Empty: a default answer names the host's program.
        std::function<HttpAnswer(const HttpRequest&)> http;
        // On the door's thread, too: see Door::Events. Empty: no request has a body.
        std::function<std::optional<HttpAnswer>(const HttpRequest&, std::uint64_t bytes)> posted;
        // Also on the door's thread: a connection was refused; `why` is a short phrase. Optional.
        std::function<void(const std::string& address, const std::string& why)> turned_away;

        // A connection has sent its first message. The next call is `control` with that message.
        std::function<void(PeerId, const std::string& address, bool invited)> connected;
        std::function<void(PeerId, ByteView)> control;
        std::function<void(PeerId, const wire::State&)> state;  // may be empty
        std::function<void(PeerId, const wire::Voice&)> voice;  // may be empty
        // A frame has begun to leave to a peer: is_behind() may have changed. May be empty.
        std::function<void(PeerId)> frame_left;
        // A peer did not read, and control for it was dropped: send it the session's state again.
        // Empty: its connection ends.
        std::function<void(PeerId)> control_lost;
        // A media message of a peer from which it is taken (take_media), as in Connection::Events.
        // May be empty.
        std::function<bool(PeerId, Bytes&)> media;
        std::function<void(PeerId, const std::string& why)> closed;
        std::function<TimePoint()> now;  // session time
        std::function<void()> tick;      // ten times a second
        std::function<void()> alarm;     // see set_alarm()
    };

    // Begins to listen. Throws Error if the address or port cannot be had, or OpenSSL refuses the
    // certificate.
    Server(const Endpoint& endpoint, const Certificate& certificate, Handler handler,
           Access access = {});
    ~Server();

    std::uint16_t port() const;

    // Serves until stop(), with a second thread for strangers. Posted work that has not begun by
    // then is not run.
    void run();

    // From any thread.
    void stop();
    void post(std::function<void()> work);  // runs `work` on the server's thread
    // For connections from now on. Throws Error if OpenSSL refuses it; then nothing changes.
    void set_certificate(const Certificate& certificate);

    // On the server's thread only. A peer that is gone is ignored.
    void send_control(PeerId peer, ByteView control);
    void send_states(PeerId peer, std::span<const wire::State> states);
    void send_voice(PeerId peer, const wire::Voice& voice);
    Outbox::Pushed send_media(PeerId peer, Media media);
    // `content.offset` < `content.end`, both within its bytes. Dropped if too much waits already.
    void send_content(PeerId peer, Outbox::Content content);
    // Calls Handler::alarm at this time instead of the time that was set before.
    void set_alarm(TimePoint when);
    // Media of this peer is taken from now on; without this it ends the peer's connection.
    void take_media(PeerId peer, std::size_t max_message);
    // See Outbox. Figures of a peer that is gone are empty.
    void set_ceiling(PeerId peer, double bytes_per_second);
    // See Connection.
    void set_delay(PeerId peer, Duration delay);
    void keep_everything(PeerId peer);
    SendingFigures take_figures(PeerId peer);
    bool is_behind(PeerId peer, StreamId stream) const;
    void close(PeerId peer, const std::string& why);  // after the control that is queued
    void drop(PeerId peer, const std::string& why);   // at once

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace theatron::net
