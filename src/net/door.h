// SPDX-License-Identifier: Apache-2.0
// A host's door: from the listening socket to an open WebSocket whose first message has come,
// on a thread of its own, so that strangers and their handshakes never hold up pictures.
//
// Each step has a small bound (docs/decisions/strangers.md): places in net/places.h, bytes in
// wire/envelope.h, time here.
#pragma once

#include <boost/asio/io_context.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/bytes.h"
#include "net/access.h"
#include "net/certificate.h"
#include "net/connection.h"
#include "net/http.h"
#include "net/link.h"

namespace theatron::net {

class Door {
public:
    // From acceptance to the end of the HTTP request, and from then to the first message or
    // the end of the answer.
    static constexpr Duration request_deadline = std::chrono::seconds(3);
    static constexpr Duration first_message_deadline = std::chrono::seconds(2);
    // To the end of an answer of more than large_answer bytes, which takes time on a slow link.
    static constexpr Duration large_answer_deadline = std::chrono::seconds(30);
    static constexpr std::size_t large_answer = 64 * 1024;
    // Largest head of an HTTP request: a browser adds the cookies of other services of the same
    // name, often 16 KiB in a hospital.
    static constexpr std::size_t max_request_bytes = 32 * 1024;
    // To the end of a body that is read and dropped.
    static constexpr Duration body_deadline = std::chrono::seconds(5);
    // Bytes behind a request that is answered with a refusal that are read, so that its answer
    // arrives: one without TLS, or with a larger head.
    static constexpr std::size_t max_unread_bytes = 64 * 1024;
    // For which browsers keep that a name has only HTTPS.
    static constexpr Duration https_only = std::chrono::hours(365 * 24);
    // Receive buffers of sockets before and after the token was shown. Linux doubles them.
    static constexpr int stranger_receive_buffer = 16 * 1024;
    static constexpr int participant_receive_buffer = 64 * 1024;
    // When no more sockets can be had: one pending connection is closed, then this pause.
    static constexpr Duration no_socket_pause = std::chrono::milliseconds(100);

    struct Visitor {
        WebSocket socket;
        std::string address;   // behind a trusted proxy that of the proxy's client
        Bytes first;           // its first control message
        bool invited = false;  // that is a Join with the token
    };

    // All but `entered` are called on the door's thread.
    struct Events {
        std::function<bool(ByteView first_control)> invited;
        std::function<HttpAnswer(const HttpRequest&)> http;
        // A POST with a body of this many bytes. 204: the body is read and dropped, then this is
        // the answer; another status is answered at once; nullopt: 405, as where this is empty.
        std::function<std::optional<HttpAnswer>(const HttpRequest&, std::uint64_t bytes)> posted;
        std::function<void(Visitor)> entered;  // on the thread of `inside`
        // A connection was refused; `why` is a short phrase.
        std::function<void(const std::string& address, const std::string& why)> turned_away;
    };

    // Begins to listen. Sockets belong to `inside`, whose thread takes them over. Throws Error
    // if the address or port cannot be had, or OpenSSL refuses the certificate.
    Door(boost::asio::io_context& inside, const Endpoint& endpoint, const Certificate& certificate,
         Access access, Events events);
    ~Door();

    std::uint16_t port() const;

    // For connections from now on; from any thread. Throws Error if OpenSSL refuses it; then
    // nothing changes.
    void set_certificate(const Certificate& certificate);

    // Serves until stop(); on a thread of the caller.
    void run();
    void stop();  // from any thread

    // After run() and the thread of `inside` have ended, before `inside` is destroyed: close_all(),
    // then poll() of both contexts until both return 0: handlers may own the other's sockets.
    void close_all();
    std::size_t poll();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace theatron::net
