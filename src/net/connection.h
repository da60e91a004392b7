// SPDX-License-Identifier: Apache-2.0
// One WebSocket over TLS, after its handshakes: what server and client share.
//
// Reads envelopes and takes them apart; writes what its outbox says is next,
// one envelope at a time, so that the newest frame is chosen as late as
// possible. Everything runs on the io_context's one thread.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <functional>
#include <memory>
#include <string>

#include "base/fault.h"
#include "net/outbox.h"
#include "wire/envelope.h"

namespace theatron::net {

using TcpStream = boost::beast::tcp_stream;
using TlsStream = boost::beast::ssl_stream<TcpStream>;
using WebSocket = boost::beast::websocket::stream<TlsStream>;

// Keeps what the kernel holds back small, so that dropping happens in the
// outbox and not after the fact. Call once the socket is open.
void tune_socket(boost::asio::ip::tcp::socket& socket);

// A viewer's, so that pictures find room; a host's sockets need less.
inline constexpr int viewer_receive_buffer = 1 << 20;
void set_receive_buffer(boost::asio::ip::tcp::socket& socket, int bytes);

// The same settings of a WebSocket for both ends.
void configure(WebSocket& socket);

class Connection : public std::enable_shared_from_this<Connection> {
public:
    // Called on the io thread. After `closed` nothing is called any more. A call that throws
    // costs the connection.
    struct Events {
        std::function<void(ByteView)> control;
        std::function<void(ByteView)> media;
        // More media has come: bytes of all chunks so far, and whether they end a
        // message. Before `media`. May be empty.
        std::function<void(std::uint64_t media_bytes, bool message_complete)> received;
        std::function<void(const std::string& why)> closed;
        std::function<TimePoint()> now;  // session time
    };

    // `socket` has finished its handshakes. Media that is not taken ends the connection.
    Connection(WebSocket socket, wire::Unwrapper::Takes takes, Events events);

    // `first` was read before: a control message, or nothing.
    void start(ByteView first = {});

    void send_control(ByteView control);
    // The newest replaces one that waits.
    void send_acknowledgement(ByteView control);
    Outbox::Pushed send_media(Media media);

    // See Outbox.
    void acknowledge(std::uint64_t media_bytes);
    void set_ceiling(double bytes_per_second);
    void keep_everything() { outbox_.keep_everything(); }
    bool is_behind(StreamId stream) const { return outbox_.is_behind(stream); }
    SendingFigures take_figures() { return outbox_.take_figures(now_()); }
    // To be called a few times a second: gives up a peer that takes nothing.
    void look();

    // Sends what control is queued, then closes. `why` is what `closed` is told.
    void close(const std::string& why);
    void end(const std::string& why);  // at once
    void abandon();                    // at once, and `closed` is not told

private:
    void take(ByteView envelope);
    void read();
    void write();
    void finish(const std::string& why);

    // A fault in what is done for this connection ends this connection.
    template <class Work>
    void guarded(Work work) {
        const auto self = shared_from_this();
        if (!contain("net", work))
            (void)contain("net", [&] { finish("it met a fault here"); });
    }

    WebSocket socket_;
    std::shared_ptr<const Events> events_;  // empty when finished
    const std::function<TimePoint()> now_;
    boost::beast::flat_buffer incoming_;
    wire::Unwrapper unwrapper_;
    Outbox outbox_;
    boost::asio::steady_timer ceiling_timer_;
    Bytes outgoing_;
    bool writing_ = false;
    bool finished_ = false;
    std::string closing_;  // not empty: close after the control that is queued
};

}  // namespace theatron::net
