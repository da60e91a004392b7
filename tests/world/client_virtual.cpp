// SPDX-License-Identifier: Apache-2.0
// A participant's side of the network in the World: net/connection.cpp over a link of it, whose
// events come from the Schedule.
#include "net/client.h"

#include "base/fault.h"
#include "net/connection.h"
#include "phrases/phrase.h"

namespace theatron::net {
namespace {

namespace asio = boost::asio;

}  // namespace

struct Client::Impl {
    Link link;
    Handler handler;
    std::function<void(const End&)> ended;
    asio::io_context io{1};
    asio::steady_timer timer{io};
    std::shared_ptr<Connection> connection;
    bool is_finished = false;
    const std::shared_ptr<bool> lives = std::make_shared<bool>(true);

    ~Impl() { leave(); }

    std::string where() const { return link.host + ":" + std::to_string(link.port); }

    // From no handler of the connection: `ended` may begin the next one.
    void finish(const std::string& why, bool final = false) {
        if (std::exchange(is_finished, true))
            return;
        leave();
        asio::post(io, [this, why, final] { ended({why, final}); });
    }

    void leave() {
        timer.cancel();
        if (connection)
            connection->abandon();
    }

    template <class Work>
    void guarded(Work work) {
        if (!is_finished && !contain("net", work))
            finish(say(Phrase::connection_ended, say(Phrase::met_a_fault)));
    }

    void connect() {
        world::Network::instance().connect(
            link.host, link.port, std::chrono::seconds(10),
            [this, lives = std::weak_ptr(lives)](world::Fault fault,
                                                 const std::shared_ptr<world::Plug>& plug,
                                                 const std::string& fingerprint) {
                if (!lives.expired() && !is_finished)
                    guarded([&] { on_connected(fault, plug, fingerprint); });
                else if (plug)
                    plug->close();
            });
    }

    void on_connected(world::Fault fault, const std::shared_ptr<world::Plug>& plug,
                      const std::string& fingerprint) {
        if (fault != world::Fault::none)
            return finish(
                say(Phrase::no_host_answers_because, where(), world::ErrorCode{fault}.message()));
        if (fingerprint != link.fingerprint) {
            plug->close();
            return finish(say(Phrase::other_certificate, where()), true);
        }
        Connection::Events events;
        events.control = handler.control;
        events.media = handler.media;
        events.state = handler.state;
        events.voice = handler.voice;
        events.closed = [this](const std::string& why) {
            finish(say(Phrase::connection_ended, why));
        };
        events.now = handler.now;
        connection = std::make_shared<Connection>(
            WebSocket(io, plug), wire::Unwrapper::Takes::everything, std::move(events));
        connection->start();
        handler.connected();
    }

    void tick() {
        timer.expires_after(std::chrono::milliseconds(100));
        timer.async_wait([this](asio::error_code error) {
            if (error || is_finished)
                return;
            guarded([this] {
                if (!connection)
                    return;
                connection->look();
                if (!is_finished && handler.tick)
                    handler.tick();
            });
            if (!is_finished)
                tick();
        });
    }
};

Client::Client(Link link, Handler handler) : impl_(std::make_unique<Impl>()) {
    impl_->link = std::move(link);
    impl_->handler = std::move(handler);
}

Client::~Client() = default;

void Client::start(std::function<void(const End&)> ended) {
    impl_->ended = std::move(ended);
    impl_->connect();
    impl_->tick();
}

void Client::post(std::function<void()> work) {
    asio::post(impl_->io, [impl = impl_.get(), work = std::move(work)] { impl->guarded(work); });
}

void Client::end(const std::string& why) {
    impl_->finish(why);
}

void Client::send_control(ByteView control) {
    if (impl_->connection)
        impl_->connection->send_control(control);
}

void Client::send_states(std::span<const wire::State> states) {
    if (impl_->connection)
        impl_->connection->send_states(states);
}

void Client::send_voice(const wire::Voice& voice) {
    if (impl_->connection)
        impl_->connection->send_voice(voice);
}

void Client::taken(std::size_t bytes) {
    if (impl_->connection)
        impl_->connection->taken(bytes);
}

Outbox::Pushed Client::send_media(Media media) {
    return impl_->connection ? impl_->connection->send_media(std::move(media))
                             : Outbox::Pushed{1, true};
}

}  // namespace theatron::net
