// SPDX-License-Identifier: Apache-2.0
// The host's side of the network: one TLS 1.3 port, one WebSocket per
// participant. What the messages mean is its user's business.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "net/certificate.h"
#include "net/link.h"
#include "net/outbox.h"

namespace theatron::net {

// One accepted connection, numbered from 1.
enum class PeerId : std::uint32_t {};

// What a browser or a monitoring system asks without a WebSocket.
struct HttpRequest {
    std::string target;         // path and query
    std::string authorization;  // that header
};
struct HttpAnswer {
    int status = 200;
    std::string type = "text/plain; charset=utf-8";
    std::string body;
};

class Server {
public:
    // All called on the thread that runs the server.
    struct Handler {
        std::function<void(PeerId, const std::string& address)> connected;
        std::function<void(PeerId, ByteView)> control;
        std::function<void(PeerId, ByteView)> media;
        std::function<void(PeerId, const std::string& why)> closed;
        std::function<TimePoint()> now;  // session time
        std::function<void()> tick;      // ten times a second
        // May be empty, and may answer nothing: then the host says what it is.
        std::function<std::optional<HttpAnswer>(const HttpRequest&)> http;
    };

    // Begins to listen. Throws Error if the address or port cannot be had.
    Server(const Endpoint& endpoint, const Certificate& certificate, Handler handler);
    ~Server();

    std::uint16_t port() const;

    // Serves until stop(). Calls everything in Handler.
    void run();

    // From any thread.
    void stop();
    void post(std::function<void()> work);  // runs `work` on the server's thread

    // On the server's thread only. A peer that is gone is ignored.
    void send_control(PeerId peer, ByteView control);
    Outbox::Pushed send_media(PeerId peer, Media media);
    // See Outbox. Figures of a peer that is gone are empty.
    void acknowledge(PeerId peer, std::uint64_t media_bytes);
    void set_ceiling(PeerId peer, double bytes_per_second);
    void keep_everything(PeerId peer);
    SendingFigures take_figures(PeerId peer);
    bool is_behind(PeerId peer, StreamId stream) const;
    void close(PeerId peer, const std::string& why);  // after the control that is queued

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace theatron::net
