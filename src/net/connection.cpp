// SPDX-License-Identifier: Apache-2.0
#include "net/connection.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <bit>
#include <utility>

#include "net/congestion_control.h"
#include "net/silence.h"
#include "net/tcp_path.h"
#include "phrases/phrase.h"

namespace theatron::net {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
namespace asio = boost::asio;

std::string describe(const beast::error_code& error) {
    if (error == websocket::error::closed || error == asio::error::eof ||
        error == asio::ssl::error::stream_truncated || error == asio::error::connection_reset)
        return say(Phrase::other_side_closed);
    if (error == beast::error::timeout)
        return say(Phrase::other_side_slow);
    return error.message();
}

}  // namespace

void tune_socket(asio::ip::tcp::socket& socket) {
    beast::error_code ignored;
    socket.set_option(asio::ip::tcp::no_delay(true), ignored);
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
    timeout.handshake_timeout = Silence::longest_handshake;
    // A silent peer is pinged after half of this time, and the connection ends after all of it.
    timeout.idle_timeout = Silence::longest;
    timeout.keep_alive_pings = true;
    socket.set_option(timeout);
}

Connection::Connection(WebSocket socket, wire::Unwrapper::Takes takes, Events events)
    : socket_(std::move(socket)),
      events_(std::make_shared<const Events>(std::move(events))),
      now_(events_->now),
      unwrapper_(takes),
      ceiling_timer_(socket_.get_executor()),
      acknowledgement_timer_(socket_.get_executor()),
      farewell_timer_(socket_.get_executor()),
      in_timer_(socket_.get_executor()),
      out_timer_(socket_.get_executor()) {}

void Connection::start(ByteView first) {
    beast::get_lowest_layer(socket_).expires_never();
    guarded([&] {
        if (!first.empty()) {
            acknowledger_.came(first.size() + 1, false, now_());
            events_->control(first);
        }
        if (finished_)
            return;
        read();
        write();
    });
}

void Connection::send_control(ByteView control) {
    if (finished_ || !closing_.empty())
        return;
    if (!outbox_.push_control(wire::wrap_control(control))) {
        if (!events_->control_lost)
            return finish(say(Phrase::other_side_reads_not));
        const auto events = events_;
        events->control_lost();
        if (finished_)
            return;
    }
    write();
}

void Connection::send_states(std::span<const wire::State> states) {
    if (finished_ || !closing_.empty())
        return;
    for (const wire::State& state : states)
        outbox_.put_state(state);
    write();
}

void Connection::send_voice(const wire::Voice& voice) {
    if (finished_ || !closing_.empty())
        return;
    outbox_.push_voice(voice);
    write();
}

void Connection::send_content(Outbox::Content content) {
    if (finished_ || !closing_.empty())
        return;
    (void)outbox_.push_content(std::move(content));
    write();
}

void Connection::taken(std::size_t bytes) {
    acknowledger_.taken(bytes, now_());
    acknowledge();
}

// Sends an acknowledgement of the taken bytes, now or when the next one is due.
void Connection::acknowledge() {
    if (finished_)
        return;
    if (const auto acknowledgement = acknowledger_.due(now_())) {
        outbox_.put_acknowledgement(*acknowledgement);
        write();
    }
    const auto again = acknowledger_.ask_again();
    if (!again || std::exchange(acknowledgement_is_timed_, true))
        return;
    acknowledgement_timer_.expires_after(std::max(*again - now_(), Duration(0)));
    acknowledgement_timer_.async_wait([self = shared_from_this()](beast::error_code error) {
        self->acknowledgement_is_timed_ = false;
        if (!error)
            self->guarded([&] { self->acknowledge(); });
    });
}

// Keeps the kernel's queue of unsent bytes short. Frames are then dropped in the outbox while they
// are still whole, and the next envelope waits behind few bytes.
void Connection::limit_unsent() {
    const std::size_t limit = std::bit_floor(outbox_.unsent_limit());
    if (std::exchange(unsent_limit_, limit) == limit)
        return;
    const int value = int(limit);
    setsockopt(beast::get_lowest_layer(socket_).socket().native_handle(), IPPROTO_TCP,
               TCP_NOTSENT_LOWAT, &value, sizeof(value));
}

// True: more may leave than before. BBR keeps its rate on a link that loses packets; on others it
// would stop for 0.2 s every ten seconds to measure the round trip.
bool Connection::see_path() {
    const int descriptor = beast::get_lowest_layer(socket_).socket().native_handle();
    const auto path = tcp_path(descriptor);
    if (!path)
        return false;
    if (!prefers_bbr_ && losses_.note(path->sent_again, now_())) {
        prefers_bbr_ = true;
        prefer_bbr(descriptor);
    }
    return outbox_.see(*path, now_());
}

// The window is also full when much waits at the peer behind a packet that was lost.
bool Connection::choose(Bytes& envelope) {
    return outbox_.next(envelope, now_()) ||
           (outbox_.window_is_full() && see_path() && outbox_.next(envelope, now_()));
}

Outbox::Pushed Connection::send_media(Media media) {
    if (finished_ || !closing_.empty())
        return {1, false};
    media.queued = now_();
    const Outbox::Pushed pushed = outbox_.push_media(std::move(media));
    write();
    return pushed;
}

void Connection::set_ceiling(double bytes_per_second) {
    outbox_.set_ceiling(bytes_per_second);
    write();
}

SendingFigures Connection::take_figures() {
    SendingFigures figures = outbox_.take_figures(now_());
    figures.loses_packets = prefers_bbr_;
    figures.round_trip = std::max(figures.round_trip - 2 * out_.delay(), Duration(0));
    figures.delay = std::max(figures.delay - out_.delay(), Duration(0));
    return figures;
}

void Connection::set_delay(Duration delay) {
    if (!closing_.empty())
        return;
    in_.set_delay(delay);
    out_.set_delay(delay);
}

void Connection::look() {
    if (!finished_ && outbox_.stands_still(now_()))
        finish(say(Phrase::took_nothing,
                   std::to_string(Outbox::give_up_after / std::chrono::seconds(1))));
}

void Connection::make_room() {
    guarded([&] {
        finish(say(Phrase::took_nothing,
                   std::to_string(outbox_.held(now_()).still / std::chrono::seconds(1))));
    });
}

void Connection::close(const std::string& why) {
    if (finished_ || !closing_.empty())
        return;
    closing_ = why;
    // A peer that is sent away gets nothing more of the others, and learns the reason at once.
    in_.hurry([](ByteView) { return false; });
    out_.hurry(wire::is_control);
    out_timer_.cancel();
    write();
}

void Connection::end(const std::string& why) {
    guarded([&] { finish(why); });
}

void Connection::abandon() {
    events_ = nullptr;
    finish("");
}

void Connection::take(ByteView envelope) {
    const auto unwrapped = unwrapper_.take(envelope);
    if (!unwrapped)
        return finish(say(Phrase::other_side_wrong, to_text(unwrapped.error())));
    if (unwrapped->acknowledgement) {
        (void)see_path();
        outbox_.acknowledge(*unwrapped->acknowledgement, now_());
        return write();
    }
    acknowledger_.came(envelope.size(), unwrapped->is_media, now_());
    hand_on(*unwrapped);
    acknowledge();
}

// A handler may end this connection, and `closed` may destroy the owner of the handlers. So this
// function shares their ownership until the last call has returned.
void Connection::hand_on(const wire::Unwrapper::Unwrapped& unwrapped) {
    const auto events = events_;
    if (!unwrapped.control.empty())
        return events->control(unwrapped.control);
    if (unwrapped.media) {
        const std::size_t size = unwrapped.media->size();
        acknowledger_.waits(size);
        if (!events->media || events->media(*unwrapped.media))
            acknowledger_.taken(size, now_());
    }
    if (unwrapped.voice && events->voice)
        events->voice(*unwrapped.voice);
    wire::StateReader states(unwrapped.states);
    for (wire::State state; !finished_ && events->state && states.next(state);)
        events->state(state);
}

void Connection::read() {
    socket_.async_read(
        incoming_, [self = shared_from_this()](beast::error_code error, std::size_t) {
            self->guarded([&] {
                if (self->finished_)
                    return;
                if (error)
                    return self->finish(self->only_reads_ ? self->closing_ : describe(error));
                const auto data = self->incoming_.cdata();
                if (!self->closing_.empty())
                    self->late_bytes_ += data.size();
                const ByteView envelope{static_cast<const std::byte*>(data.data()), data.size()};
                if (!self->only_reads_ && self->in_.is_used()) {
                    self->in_.push({envelope.begin(), envelope.end()}, self->now_());
                    self->take_delayed();
                } else if (!self->only_reads_) {
                    self->take(envelope);
                }
                self->incoming_.consume(self->incoming_.size());
                if (!self->only_reads_ && self->late_bytes_ > max_last_bytes)
                    self->finish(self->closing_);
                const bool is_flood = self->only_reads_ && self->late_bytes_ > max_discarded_bytes;
                self->waits_to_read_ = self->in_.bytes() > max_delayed_bytes;
                if (!self->finished_ && !is_flood && !self->waits_to_read_)
                    self->read();
            });
        });
}

// Hands on the envelopes that have waited for their time.
void Connection::take_delayed() {
    while (!finished_ && !only_reads_)
        if (const auto envelope = in_.take(now_()))
            take(*envelope);
        else
            break;
    if (finished_)
        return;
    if (waits_to_read_ && in_.bytes() <= max_delayed_bytes) {
        waits_to_read_ = false;
        read();
    }
    const auto due = in_.due();
    if (!due || only_reads_)
        return;
    in_timer_.expires_after(std::max(*due - now_(), Duration(0)));
    in_timer_.async_wait([self = shared_from_this()](beast::error_code error) {
        if (!error)
            self->guarded([&] { self->take_delayed(); });
    });
}

void Connection::write() {
    if (writing_ || finished_ || only_reads_)
        return;
    if (out_.is_used())
        return write_delayed();
    const std::uint64_t begun_before = outbox_.begun_frames();
    if (!choose(outgoing_)) {
        if (!closing_.empty() && !outbox_.control_waits())
            return bid_farewell();
        if (const auto again = outbox_.ask_again())
            write_later(*again);
        return;
    }
    begin_write(begun_before);
}

// The outbox chooses as if the bytes left at once; they leave when their time has come.
void Connection::write_delayed() {
    const std::uint64_t begun_before = outbox_.begun_frames();
    for (Bytes envelope; choose(envelope); envelope.clear())
        out_.push(std::move(envelope), now_());
    if (auto envelope = out_.take(now_())) {
        outgoing_ = std::move(*envelope);
        return begin_write(begun_before);
    }
    tell_begun(begun_before);
    if (const auto again = outbox_.ask_again())
        write_later(*again);
    const auto due = out_.due();
    if (!due) {
        if (!closing_.empty() && !outbox_.control_waits())
            bid_farewell();
        return;
    }
    out_timer_.expires_after(std::max(*due - now_(), Duration(0)));
    out_timer_.async_wait([self = shared_from_this()](beast::error_code error) {
        if (!error)
            self->guarded([&] { self->write(); });
    });
}

void Connection::begin_write(std::uint64_t begun_before) {
    limit_unsent();
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
    tell_begun(begun_before);
}

void Connection::tell_begun(std::uint64_t begun_before) {
    if (outbox_.begun_frames() != begun_before && events_->frame_left) {
        const auto events = events_;
        events->frame_left();
    }
}

void Connection::write_later(TimePoint then) {
    ceiling_timer_.expires_after(std::max(then - now_(), Duration(1000)));
    ceiling_timer_.async_wait([self = shared_from_this()](beast::error_code error) {
        if (!error)
            self->guarded([&] { self->write(); });
    });
}

void Connection::bid_farewell() {
    only_reads_ = true;
    beast::error_code ignored;
    beast::get_lowest_layer(socket_).socket().shutdown(asio::ip::tcp::socket::shutdown_send,
                                                       ignored);
    farewell_timer_.expires_after(max_farewell);
    farewell_timer_.async_wait([self = shared_from_this()](beast::error_code error) {
        if (!error)
            self->end(self->closing_);
    });
}

void Connection::finish(const std::string& why) {
    if (finished_)
        return;
    finished_ = true;
    ceiling_timer_.cancel();
    acknowledgement_timer_.cancel();
    in_timer_.cancel();
    out_timer_.cancel();
    farewell_timer_.cancel();
    // No closing handshakes: they would wait for a peer that may be gone, and
    // every message is complete in itself.
    beast::error_code ignored;
    beast::get_lowest_layer(socket_).socket().shutdown(asio::ip::tcp::socket::shutdown_both,
                                                       ignored);
    beast::get_lowest_layer(socket_).close();
    // Moved out first: nothing may be called after `closed`, and `closed` may call this object.
    if (const auto events = std::exchange(events_, nullptr); events && events->closed)
        events->closed(why);
}

}  // namespace theatron::net
