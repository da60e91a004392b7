// SPDX-License-Identifier: Apache-2.0
#include "net/connection.h"

#include <netinet/tcp.h>
#include <sys/socket.h>

#include <utility>

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
    // Bytes that the kernel takes before the network has room for them.
    constexpr int unsent_limit = 64 * 1024;
    setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &unsent_limit,
               sizeof(unsent_limit));
}

// A peer that stops reading must not find seconds of old frames when it wakes.
void set_receive_buffer(asio::ip::tcp::socket& socket, int bytes) {
    beast::error_code ignored;
    socket.set_option(asio::socket_base::receive_buffer_size(bytes), ignored);
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

Connection::Connection(WebSocket socket, wire::Unwrapper::Takes takes, Events events)
    : socket_(std::move(socket)),
      events_(std::make_shared<const Events>(std::move(events))),
      now_(events_->now),
      unwrapper_(takes),
      ceiling_timer_(socket_.get_executor()) {}

void Connection::start(ByteView first) {
    beast::get_lowest_layer(socket_).expires_never();
    guarded([&] {
        if (!first.empty())
            events_->control(first);
        if (finished_)
            return;
        read();
        write();
    });
}

void Connection::send_control(ByteView control) {
    if (finished_ || !closing_.empty())
        return;
    if (!outbox_.push_control(wire::wrap_control(control)))
        return finish("the other side does not read");
    write();
}

void Connection::send_acknowledgement(ByteView control) {
    if (finished_ || !closing_.empty())
        return;
    outbox_.put_acknowledgement(wire::wrap_control(control));
    write();
}

Outbox::Pushed Connection::send_media(Media media) {
    if (finished_ || !closing_.empty())
        return {1, false};
    media.queued = now_();
    const Outbox::Pushed pushed = outbox_.push_media(std::move(media));
    write();
    return pushed;
}

void Connection::acknowledge(std::uint64_t media_bytes) {
    outbox_.acknowledge(media_bytes, now_());
    write();
}

void Connection::set_ceiling(double bytes_per_second) {
    outbox_.set_ceiling(bytes_per_second);
    write();
}

void Connection::look() {
    if (!finished_ && outbox_.stands_still(now_()))
        finish("it took nothing for " +
               std::to_string(Outbox::give_up_after / std::chrono::seconds(1)) + " s");
}

void Connection::close(const std::string& why) {
    if (finished_ || !closing_.empty())
        return;
    closing_ = why;
    write();
}

void Connection::end(const std::string& why) {
    guarded([&] { finish(why); });
}

void Connection::abandon() {
    events_ = nullptr;
    finish("");
}

// What is called may end this connection, and `closed` may destroy who owns the handlers: they
// are kept until the last call has returned.
void Connection::take(ByteView envelope) {
    const auto events = events_;
    const std::uint64_t media_before = unwrapper_.media_bytes();
    const auto unwrapped = unwrapper_.take(envelope);
    if (!unwrapped)
        return finish("the other side sent a message that is " +
                      std::string(to_text(unwrapped.error())));
    const std::uint64_t media_bytes = unwrapper_.media_bytes();
    if (media_bytes != media_before && events->received)
        events->received(media_bytes, !unwrapped->media.empty());
    if (!finished_ && !unwrapped->control.empty())
        events->control(unwrapped->control);
    if (!finished_ && !unwrapped->media.empty())
        events->media(unwrapped->media);
}

void Connection::read() {
    socket_.async_read(
        incoming_, [self = shared_from_this()](beast::error_code error, std::size_t) {
            self->guarded([&] {
                if (self->finished_)
                    return;
                if (error)
                    return self->finish(describe(error));
                const auto data = self->incoming_.cdata();
                self->take({static_cast<const std::byte*>(data.data()), data.size()});
                self->incoming_.consume(self->incoming_.size());
                if (!self->finished_)
                    self->read();
            });
        });
}

void Connection::write() {
    if (writing_ || finished_)
        return;
    if (!outbox_.next(outgoing_, now_())) {
        if (!closing_.empty())
            return finish(closing_);
        if (const auto again = outbox_.ask_again()) {
            ceiling_timer_.expires_after(std::max(*again - now_(), Duration(1000)));
            ceiling_timer_.async_wait([self = shared_from_this()](beast::error_code error) {
                if (!error)
                    self->guarded([&] { self->write(); });
            });
        }
        return;
    }
    writing_ = true;
    socket_.async_write(asio::buffer(outgoing_),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                            self->guarded([&] {
                                self->writing_ = false;
                                if (self->finished_)
                                    return;
                                if (error)
                                    return self->finish(describe(error));
                                self->write();
                            });
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
    // Moved out first: nothing may be called after `closed`, and who is called may call back.
    if (const auto events = std::exchange(events_, nullptr); events && events->closed)
        events->closed(why);
}

}  // namespace theatron::net
