// SPDX-License-Identifier: Apache-2.0
// One WebSocket over TLS, after its handshakes: what server and client share.
//
// Reads and parses envelopes; writes the envelopes that its outbox chooses, one at
// a time, so that the newest frame is chosen as late as possible. Everything runs
// on the io_context's one thread.
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
#include "net/acknowledger.h"
#include "net/delay_line.h"
#include "net/loss_watch.h"
#include "net/outbox.h"
#include "wire/envelope.h"

namespace theatron::net {

using TcpStream = boost::beast::tcp_stream;
using TlsStream = boost::beast::ssl_stream<TcpStream>;
using WebSocket = boost::beast::websocket::stream<TlsStream>;

// Sends small messages at once. Call once the socket is open.
void tune_socket(boost::asio::ip::tcp::socket& socket);

// Receive buffer of a viewer's socket, bytes: large enough for pictures. A host needs less.
inline constexpr int viewer_receive_buffer = 1 << 20;
void set_receive_buffer(boost::asio::ip::tcp::socket& socket, int bytes);

// The same settings of a WebSocket for both ends.
void configure(WebSocket& socket);

class Connection : public std::enable_shared_from_this<Connection> {
public:
    // Waiting for a peer to close, and bytes from it that are discarded meanwhile; then nothing
    // more is read of it.
    static constexpr Duration max_farewell = std::chrono::milliseconds(500);
    static constexpr std::size_t max_discarded_bytes = std::size_t(64) << 10;
    // Bytes from a peer that does not take its last control messages; then the connection ends.
    static constexpr std::size_t max_last_bytes = std::size_t(4) << 20;
    // Bytes of a peer that wait out set_delay(); then nothing more is read until some have.
    static constexpr std::size_t max_delayed_bytes = std::size_t(16) << 20;

    // Called on the io thread. After `closed` nothing is called any more. A call that throws
    // costs the connection. All but `control`, `closed` and `now` may be empty.
    struct Events {
        std::function<void(ByteView)> control;
        // A complete media message, which may be moved away or exchanged for other memory. True:
        // it has been taken. False: it waits, and taken() must be called with its size later.
        std::function<bool(Bytes&)> media;
        std::function<void(const wire::State&)> state;
        std::function<void(const wire::Voice&)> voice;
        // A frame of media has begun to leave.
        std::function<void()> frame_left;
        // More control waited than the outbox keeps, and all of it was dropped. If this handler is
        // empty the connection ends.
        std::function<void()> control_lost;
        std::function<void(const std::string& why)> closed;
        std::function<TimePoint()> now;  // a steady clock; of a host, session time
    };

    // `socket` has finished its handshakes. Media that is not taken ends the connection.
    Connection(WebSocket socket, wire::Unwrapper::Takes takes, Events events);

    // `first` was read before: a control message, or nothing.
    void start(ByteView first = {});

    void send_control(ByteView control);
    void send_states(std::span<const wire::State> states);
    void send_voice(const wire::Voice& voice);
    void send_content(Outbox::Content content);
    Outbox::Pushed send_media(Media media);
    // A media message of this size that waited has been taken: see Events::media.
    void taken(std::size_t bytes);

    // Media is taken from now on; see Unwrapper.
    void take_media(std::size_t max_message) { unwrapper_.take_media(max_message); }

    // See Outbox.
    void set_ceiling(double bytes_per_second);
    void keep_everything() { outbox_.keep_everything(); }
    bool is_behind(StreamId stream) const { return outbox_.is_behind(stream); }
    // Without the time of set_delay(): the link is measured, and not what was added to it.
    SendingFigures take_figures();
    // Everything to the peer and from it is this much later from now on.
    void set_delay(Duration delay);
    // To be called a few times a second: closes the connection if the peer takes nothing.
    void look();
    // After look().
    HeldPictures held() const { return outbox_.held(now_()); }
    // The peer took nothing, and others need the memory.
    void make_room();

    // Sends the control messages that are queued, then closes as soon as the peer has closed too,
    // or after a short time, in which the peer can read what was sent last. Meanwhile a few of its
    // messages are discarded, and a flood of them is not read. `closed` is called with `why`.
    void close(const std::string& why);
    void end(const std::string& why);  // at once
    void abandon();                    // at once, without calling `closed`

private:
    void take(ByteView envelope);
    void hand_on(const wire::Unwrapper::Unwrapped& unwrapped);
    void acknowledge();
    void limit_unsent();
    bool see_path();
    bool choose(Bytes& envelope);
    void read();
    void write();
    void write_later(TimePoint then);
    void take_delayed();
    void write_delayed();
    void begin_write(std::uint64_t begun_before);
    void tell_begun(std::uint64_t begun_before);
    void bid_farewell();
    void finish(const std::string& why);

    // An exception from `work` ends this connection only.
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
    Acknowledger acknowledger_;
    Outbox outbox_;
    std::size_t unsent_limit_ = 0;  // bytes, as set on the socket
    LossWatch losses_;
    bool prefers_bbr_ = false;
    boost::asio::steady_timer ceiling_timer_, acknowledgement_timer_, farewell_timer_, in_timer_,
        out_timer_;
    bool acknowledgement_is_timed_ = false;
    Bytes outgoing_;
    bool writing_ = false;
    DelayLine in_, out_;
    bool waits_to_read_ = false;  // too much waits in `in_`
    bool finished_ = false;
    std::string closing_;         // not empty: close after the control that is queued
    bool only_reads_ = false;     // that control has been sent
    std::size_t late_bytes_ = 0;  // from the peer since close()
};

}  // namespace theatron::net
