// SPDX-License-Identifier: Apache-2.0
// A participant's side of the network in a browser's page: its WebSocket, its events, its timers.
// Sending policy and acknowledgements are those of net/connection.cpp.
#include <emscripten/emscripten.h>
#include <emscripten/eventloop.h>
#include <emscripten/html5.h>
#include <emscripten/websocket.h>

#include <deque>

#include "base/fault.h"
#include "net/acknowledger.h"
#include "net/client.h"
#include "net/silence.h"
#include "phrases/phrase.h"

// Emscripten 3.1 keeps sockets that were deleted (it deletes another key of its table).
EM_JS(void, theatron_forget_socket, (int socket), { WS.sockets[socket] = null; });

// Emscripten copies a message of any size into the program's memory, which never shrinks again. The
// program gets `most` bytes and one more of a larger message, and refuses it.
EM_JS(void, theatron_bound_messages, (int socket, unsigned most), {
    const take = WS.sockets[socket].onmessage;
    WS.sockets[socket].onmessage = function(event) {
        const size = event.data.byteLength || event.data.length;
        take(size > most ? ({data : event.data.slice(0, most + 1)}) : event);
    };
});

namespace theatron::net {
namespace {

constexpr double tick_ms = 100;
constexpr Duration tick_every = std::chrono::milliseconds(100);
// Bytes that may wait in the browser's own queue: what is sent next is then still chosen late.
constexpr std::size_t most_unsent = 64 * 1024;

// It goes on while the machine sleeps, which a browser's steady clock need not do.
TimePoint wall_now() {
    return TimePoint(
        std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch()));
}

std::string url_of(const Link& link) {
    return "wss://" + host_and_port(link) + "/connection";
}

}  // namespace

struct Client::Impl {
    Link link;
    Handler handler;
    std::function<void(const End&)> ended;
    EMSCRIPTEN_WEBSOCKET_T socket = 0;
    long interval = 0, soon = 0;  // of the browser; 0: none
    bool is_open = false, is_finished = false;
    wire::Unwrapper unwrapper;
    Acknowledger acknowledger;
    Outbox outbox;
    Bytes outgoing;
    Silence silence;
    TimePoint began, next_tick;
    std::deque<std::function<void()>> posted;

    // The control messages that wait leave, too, whatever the browser has not sent yet.
    ~Impl() {
        if (!is_finished)
            (void)contain("net", [this] { write_control(); });
        close();
    }

    std::string where() const { return host_and_port(link); }

    void close() {
        if (interval != 0)
            emscripten_clear_interval(std::exchange(interval, 0));
        if (soon != 0)
            emscripten_clear_timeout(std::exchange(soon, 0));
        if (socket > 0) {
            emscripten_websocket_close(socket, 1000, "");
            emscripten_websocket_delete(socket);
            theatron_forget_socket(std::exchange(socket, 0));
        }
    }

    void finish(const std::string& why) {
        if (std::exchange(is_finished, true))
            return;
        close();
        (void)contain("net", [&] { ended({why, false}); });
    }

    template <class... Arguments>
    void end(Phrase why, const Arguments&... arguments) {
        finish(say(Phrase::connection_ended, say(why, arguments...)));
    }

    // Runs the handler of one of the browser's events, then what was posted meanwhile.
    template <class Work>
    void on_event(Work work) {
        if (is_finished)
            return;
        const bool done = contain("net", [&] {
            work();
            end_if_lost();
            tick_if_due();
            while (!posted.empty() && !is_finished) {
                const auto next = std::move(posted.front());
                posted.pop_front();
                next();
            }
            if (!is_finished)
                write();
        });
        if (!done)
            end(Phrase::met_a_fault);
    }

    void end_if_lost() {
        const TimePoint now = handler.now();
        if (is_finished)
            return;
        if (silence.has_slept(now, wall_now()))
            return end(Phrase::computer_slept);
        if (silence.is_too_long(now))
            return end(Phrase::host_is_silent);
        if (!is_open && now - began > Silence::longest_handshake)
            finish(say(Phrase::no_host_answers, where()));
    }

    // Browsers slow the timers of a hidden page down, but not its messages.
    void tick_if_due() {
        const TimePoint now = handler.now();
        if (!is_open || is_finished || now < next_tick)
            return;
        next_tick = now + tick_every;
        if (outbox.stands_still(now))
            return end(Phrase::host_takes_nothing);
        if (handler.tick)
            handler.tick();
    }

    void acknowledge() {
        if (const auto due = acknowledger.due(handler.now()))
            outbox.put_acknowledgement(*due);
        if (acknowledger.ask_again())
            later();
    }

    void write() {
        if (!is_open)
            return;
        acknowledge();
        unsigned long long waiting = 0;
        emscripten_websocket_get_buffered_amount(socket, &waiting);
        while (waiting < most_unsent && outbox.next(outgoing, handler.now())) {
            emscripten_websocket_send_binary(socket, outgoing.data(),
                                             std::uint32_t(outgoing.size()));
            waiting += outgoing.size();
        }
    }

    void write_control() {
        while (is_open && outbox.control_waits() && outbox.next(outgoing, handler.now()))
            emscripten_websocket_send_binary(socket, outgoing.data(),
                                             std::uint32_t(outgoing.size()));
    }

    // An event of its own, as soon as the browser likes.
    void later() {
        if (soon != 0 || is_finished)
            return;
        soon = emscripten_set_timeout(
            [](void* data) {
                auto& self = *static_cast<Impl*>(data);
                self.soon = 0;
                self.on_event([] {});
            },
            0, this);
    }

    void take(ByteView envelope) {
        const auto unwrapped = unwrapper.take(envelope);
        if (!unwrapped)
            return end(Phrase::other_side_wrong, to_text(unwrapped.error()));
        if (unwrapped->acknowledgement)
            return outbox.acknowledge(*unwrapped->acknowledgement, handler.now());
        acknowledger.came(envelope.size(), unwrapped->is_media, handler.now());
        if (!unwrapped->control.empty())
            return handler.control(unwrapped->control);
        if (unwrapped->media) {
            const std::size_t size = unwrapped->media->size();
            acknowledger.waits(size);
            if (!handler.media || handler.media(*unwrapped->media))
                acknowledger.taken(size, handler.now());
        }
        if (unwrapped->voice && handler.voice)
            handler.voice(*unwrapped->voice);
        wire::StateReader states(unwrapped->states);
        for (wire::State state; handler.state && states.next(state);)
            handler.state(state);
    }

    static EM_BOOL on_open(int, const EmscriptenWebSocketOpenEvent*, void* data) {
        auto& self = *static_cast<Impl*>(data);
        self.is_open = true;
        self.on_event([&] { self.handler.connected(); });
        return EM_TRUE;
    }
    static EM_BOOL on_message(int, const EmscriptenWebSocketMessageEvent* event, void* data) {
        auto& self = *static_cast<Impl*>(data);
        self.silence.heard();
        self.on_event([&] {
            if (event->isText)
                return self.end(Phrase::other_side_sent_text);
            self.take({reinterpret_cast<const std::byte*>(event->data), event->numBytes});
        });
        return EM_TRUE;
    }
    static EM_BOOL on_close(int, const EmscriptenWebSocketCloseEvent*, void* data) {
        auto& self = *static_cast<Impl*>(data);
        // A browser does not tell scripts why.
        if (self.is_open)
            self.end(Phrase::other_side_closed);
        else
            self.finish(say(Phrase::no_host_or_distrust, self.where()));
        return EM_TRUE;
    }

    void start() {
        began = handler.now();
        EmscriptenWebSocketCreateAttributes attributes;
        emscripten_websocket_init_create_attributes(&attributes);
        const std::string url = url_of(link);
        attributes.url = url.c_str();
        socket = emscripten_websocket_new(&attributes);
        if (socket <= 0) {
            socket = 0;
            // Not from within start().
            posted.push_back([this] { finish(say(Phrase::browser_opens_nothing)); });
            return later();
        }
        emscripten_websocket_set_onopen_callback(socket, this, on_open);
        emscripten_websocket_set_onmessage_callback(socket, this, on_message);
        theatron_bound_messages(socket, unsigned(wire::max_envelope_size));
        emscripten_websocket_set_onclose_callback(socket, this, on_close);
        interval = emscripten_set_interval(
            [](void* data) { static_cast<Impl*>(data)->on_event([] {}); }, tick_ms, this);
    }
};

Client::Client(Link link, Handler handler) : impl_(std::make_unique<Impl>()) {
    impl_->link = std::move(link);
    impl_->handler = std::move(handler);
}

Client::~Client() = default;

void Client::start(std::function<void(const End&)> ended) {
    impl_->ended = std::move(ended);
    impl_->start();
}

void Client::post(std::function<void()> work) {
    impl_->posted.push_back(std::move(work));
    impl_->later();
}

void Client::end(const std::string& why) {
    impl_->finish(why);
}

void Client::send_control(ByteView control) {
    if (!impl_->outbox.push_control(wire::wrap_control(control)))
        impl_->end(Phrase::other_side_reads_not);
    impl_->silence.sent(impl_->handler.now());
    impl_->later();
}

void Client::send_states(std::span<const wire::State> states) {
    for (const wire::State& state : states)
        impl_->outbox.put_state(state);
    impl_->later();
}

void Client::send_voice(const wire::Voice& voice) {
    impl_->outbox.push_voice(voice);
    impl_->later();
}

void Client::taken(std::size_t bytes) {
    impl_->acknowledger.taken(bytes, impl_->handler.now());
    impl_->later();
}

Outbox::Pushed Client::send_media(Media media) {
    media.queued = impl_->handler.now();
    const Outbox::Pushed pushed = impl_->outbox.push_media(std::move(media));
    impl_->later();
    return pushed;
}

}  // namespace theatron::net
