// SPDX-License-Identifier: Apache-2.0
#include "net/connection.h"

#include <netinet/tcp.h>
#include <sys/socket.h>

namespace theatron::net {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
namespace asio = boost::asio;

std::string describe(const beast::error_code& error) {
    if (error == websocket::error::closed || error == asio::error::eof ||
        error == asio::ssl::error::stream_truncated || error == asio::error::connection_reset)
        return "the other side closed the connection";
    if (error == beast::error::timeout)
        return "the other side did not answer in time";
    return error.message();
}

}  // namespace

void tune_socket(asio::ip::tcp::socket& socket) {
    beast::error_code ignored;
    socket.set_option(asio::ip::tcp::no_delay(true), ignored);
    // A peer that stops reading must not find seconds of old frames when it wakes.
    socket.set_option(asio::socket_base::receive_buffer_size(1 << 20), ignored);
    // Bytes that the kernel takes before the network has room for them.
    constexpr int unsent_limit = 64 * 1024;
    setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &unsent_limit,
               sizeof(unsent_limit));
}

void configure(WebSocket& socket) {
    socket.binary(true);
    socket.auto_fragment(false);
    socket.read_message_max(wire::max_envelope_size);
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = std::chrono::seconds(10);
    // Twice in this time a silent peer is pinged; then it is given up.
    timeout.idle_timeout = std::chrono::seconds(30);
    timeout.keep_alive_pings = true;
    socket.set_option(timeout);
}

Connection::Connection(WebSocket socket, Events events)
    : socket_(std::move(socket)),
      events_(std::move(events)),
      ceiling_timer_(socket_.get_executor()) {}

void Connection::start() {
    beast::get_lowest_layer(socket_).expires_never();
    read();
    write();
}

void Connection::send_control(ByteView control) {
    if (finished_ || !closing_.empty())
        return;
    if (!outbox_.push_control(wire::wrap_control(control)))
        return finish("the other side does not read");
    write();
}

Outbox::Pushed Connection::send_media(Media media) {
    if (finished_ || !closing_.empty())
        return {1, false};
    media.queued = events_.now();
    const Outbox::Pushed pushed = outbox_.push_media(std::move(media));
    write();
    return pushed;
}

void Connection::acknowledge(std::uint64_t media_bytes) {
    outbox_.acknowledge(media_bytes, events_.now());
    write();
}

void Connection::set_ceiling(double bytes_per_second) {
    outbox_.set_ceiling(bytes_per_second);
    write();
}

void Connection::close(const std::string& why) {
    if (finished_ || !closing_.empty())
        return;
    closing_ = why;
    write();
}

void Connection::read() {
    socket_.async_read(
        incoming_, [self = shared_from_this()](beast::error_code error, std::size_t) {
            if (self->finished_)
                return;
            if (error)
                return self->finish(describe(error));
            const auto data = self->incoming_.cdata();
            const std::uint64_t media_before = self->unwrapper_.media_bytes();
            const auto unwrapped =
                self->unwrapper_.take({static_cast<const std::byte*>(data.data()), data.size()});
            if (!unwrapped)
                return self->finish("the other side sent a message that is " +
                                    std::string(to_text(unwrapped.error())));
            const std::uint64_t media_bytes = self->unwrapper_.media_bytes();
            if (media_bytes != media_before && self->events_.received)
                self->events_.received(media_bytes, !unwrapped->media.empty());
            if (!unwrapped->control.empty())
                self->events_.control(unwrapped->control);
            if (!unwrapped->media.empty())
                self->events_.media(unwrapped->media);
            self->incoming_.consume(self->incoming_.size());
            if (!self->finished_)
                self->read();
        });
}

void Connection::write() {
    if (writing_ || finished_)
        return;
    if (!outbox_.next(outgoing_, events_.now())) {
        if (!closing_.empty())
            return finish(closing_);
        if (const auto again = outbox_.ask_again()) {
            ceiling_timer_.expires_after(std::max(*again - events_.now(), Duration(1000)));
            ceiling_timer_.async_wait([self = shared_from_this()](beast::error_code error) {
                if (!error)
                    self->write();
            });
        }
        return;
    }
    writing_ = true;
    socket_.async_write(asio::buffer(outgoing_),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                            self->writing_ = false;
                            if (self->finished_)
                                return;
                            if (error)
                                return self->finish(describe(error));
                            self->write();
                        });
}

void Connection::finish(const std::string& why) {
    if (finished_)
        return;
    finished_ = true;
    ceiling_timer_.cancel();
    // No closing handshakes: they would wait for a peer that may be gone, and
    // every message is complete in itself.
    beast::error_code ignored;
    beast::get_lowest_layer(socket_).socket().shutdown(asio::ip::tcp::socket::shutdown_both,
                                                       ignored);
    beast::get_lowest_layer(socket_).close();
    if (events_.closed)
        events_.closed(why);
    // The handlers may own what owns this connection.
    events_.control = nullptr;
    events_.media = nullptr;
    events_.received = nullptr;
    events_.closed = nullptr;
}

}  // namespace theatron::net
