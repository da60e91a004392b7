// SPDX-License-Identifier: Apache-2.0
#include "net/server.h"

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <deque>
#include <map>
#include <thread>
#include <utility>

#include "base/fault.h"
#include "base/log.h"
#include "net/connection.h"
#include "net/door.h"

namespace theatron::net {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;

constexpr const char* plain_answer = "This is a Theatron host. Join it with: theatron join LINK\n";

}  // namespace

struct Server::Impl {
    asio::io_context io{1};
    asio::steady_timer timer{io}, alarm{io};
    Handler handler;
    std::unique_ptr<Door> door;
    std::map<PeerId, std::shared_ptr<Connection>> peers;
    std::deque<PeerId> uninvited;  // oldest first
    std::uint32_t next_peer = 1;
    bool ended = false;  // after run(): only connections are wound up

    Door::Events door_events();
    void tick();
    void bound_memory();
    void enter(Door::Visitor visitor);
};

Door::Events Server::Impl::door_events() {
    Door::Events events;
    events.invited = [this](ByteView first) { return !handler.invited || handler.invited(first); };
    events.http = [this](const HttpRequest& request) {
        return handler.http ? handler.http(request) : HttpAnswer{.body = plain_answer};
    };
    events.posted = handler.posted;
    events.entered = [this](Door::Visitor visitor) {
        if (!ended)
            enter(std::move(visitor));
    };
    events.turned_away = [this](const std::string& address, const std::string& why) {
        if (handler.turned_away)
            handler.turned_away(address, why);
    };
    return events;
}

void Server::Impl::tick() {
    timer.expires_after(std::chrono::milliseconds(100));
    timer.async_wait([this](beast::error_code error) {
        // A wait that was over before it was cancelled has no error.
        if (error || ended)
            return;
        (void)contain("net", [this] {
            // look() may close and erase a connection.
            for (const auto& [peer, connection] : std::map(peers))
                connection->look();
            bound_memory();
            if (handler.tick)
                handler.tick();
        });
        tick();
    });
}

void Server::Impl::bound_memory() {
    std::vector<std::shared_ptr<Connection>> connections;
    std::vector<HeldPictures> held;
    for (const auto& [peer, connection] : peers) {
        connections.push_back(connection);
        held.push_back(connection->held());
    }
    for (const std::size_t i : must_go(held))
        connections[i]->make_room();
}

void Server::Impl::enter(Door::Visitor visitor) {
    if (visitor.invited && (peers.size() - uninvited.size() >= max_invited ||
                            (handler.has_place && !handler.has_place(visitor.first)))) {
        log::warning("net", "participant refused, too many connections",
                     {{"address", visitor.address}});
        return;
    }
    if (!visitor.invited && uninvited.size() >= max_uninvited)
        if (const auto oldest = peers.find(uninvited.front()); oldest != peers.end()) {
            const auto connection = oldest->second;
            connection->end("had to go for others");
        }
    const PeerId peer{next_peer++};
    Connection::Events events;
    events.control = [this, peer](ByteView bytes) { handler.control(peer, bytes); };
    if (handler.state)
        events.state = [this, peer](const wire::State& state) { handler.state(peer, state); };
    if (handler.voice)
        events.voice = [this, peer](const wire::Voice& voice) { handler.voice(peer, voice); };
    if (handler.frame_left)
        events.frame_left = [this, peer] { handler.frame_left(peer); };
    if (handler.control_lost)
        events.control_lost = [this, peer] { handler.control_lost(peer); };
    if (handler.media)
        events.media = [this, peer](Bytes& message) { return handler.media(peer, message); };
    events.closed = [this, peer](const std::string& why) {
        peers.erase(peer);
        std::erase(uninvited, peer);
        handler.closed(peer, why);
    };
    events.now = handler.now;
    configure(visitor.socket);
    set_receive_buffer(beast::get_lowest_layer(visitor.socket).socket(),
                       Door::participant_receive_buffer);
    const auto connection = std::make_shared<Connection>(
        std::move(visitor.socket), wire::Unwrapper::Takes::all_but_media, std::move(events));
    peers[peer] = connection;
    if (!visitor.invited)
        uninvited.push_back(peer);
    if (contain("net", [&] { handler.connected(peer, visitor.address, visitor.invited); }))
        connection->start(visitor.first);
    else
        connection->end("it met a fault here");
}

Server::Server(const Endpoint& endpoint, const Certificate& certificate, Handler handler,
               Access access)
    : impl_(std::make_unique<Impl>()) {
    impl_->handler = std::move(handler);
    impl_->door = std::make_unique<Door>(impl_->io, endpoint, certificate, std::move(access),
                                         impl_->door_events());
}

Server::~Server() {
    // Handlers that wait in one context may hold sockets of the other: all of them are run before
    // either context is destroyed.
    impl_->ended = true;
    impl_->door->close_all();
    impl_->timer.cancel();
    impl_->alarm.cancel();
    for (const auto& [peer, connection] : std::exchange(impl_->peers, {}))
        connection->abandon();
    do
        impl_->io.restart();
    while (impl_->io.poll() + impl_->door->poll() > 0);
}

std::uint16_t Server::port() const {
    return impl_->door->port();
}

void Server::run() {
    std::thread door([this] { impl_->door->run(); });
    impl_->tick();
    // A handler that threw cost its own connection; the others go on.
    while (!contain("net", [this] { impl_->io.run(); })) {
    }
    impl_->door->stop();
    door.join();
    impl_->ended = true;
}

void Server::set_certificate(const Certificate& certificate) {
    impl_->door->set_certificate(certificate);
}

void Server::stop() {
    impl_->io.stop();
}

void Server::post(std::function<void()> work) {
    asio::post(impl_->io, [this, work = std::move(work)] {
        if (!impl_->ended)
            (void)contain("net", work);
    });
}

void Server::send_control(PeerId peer, ByteView control) {
    const auto found = impl_->peers.find(peer);
    if (found == impl_->peers.end())
        return;
    const auto connection = found->second;  // sending may close and erase it
    connection->send_control(control);
}

Outbox::Pushed Server::send_media(PeerId peer, Media media) {
    const auto found = impl_->peers.find(peer);
    if (found == impl_->peers.end())
        return {};
    const auto connection = found->second;
    return connection->send_media(std::move(media));
}

void Server::send_content(PeerId peer, Outbox::Content content) {
    const auto found = impl_->peers.find(peer);
    if (found == impl_->peers.end())
        return;
    const auto connection = found->second;
    connection->send_content(std::move(content));
}

void Server::take_media(PeerId peer, std::size_t max_message) {
    if (const auto found = impl_->peers.find(peer); found != impl_->peers.end())
        found->second->take_media(max_message);
}

void Server::send_states(PeerId peer, std::span<const wire::State> states) {
    const auto found = impl_->peers.find(peer);
    if (found == impl_->peers.end())
        return;
    const auto connection = found->second;
    connection->send_states(states);
}

void Server::send_voice(PeerId peer, const wire::Voice& voice) {
    const auto found = impl_->peers.find(peer);
    if (found == impl_->peers.end())
        return;
    const auto connection = found->second;
    connection->send_voice(voice);
}

void Server::set_alarm(TimePoint when) {
    impl_->alarm.expires_after(std::max(when - impl_->handler.now(), Duration(0)));
    impl_->alarm.async_wait([this](beast::error_code error) {
        if (!error && !impl_->ended && impl_->handler.alarm)
            (void)contain("net", impl_->handler.alarm);
    });
}

void Server::set_ceiling(PeerId peer, double bytes_per_second) {
    const auto found = impl_->peers.find(peer);
    if (found == impl_->peers.end())
        return;
    const auto connection = found->second;
    connection->set_ceiling(bytes_per_second);
}

void Server::set_delay(PeerId peer, Duration delay) {
    const auto found = impl_->peers.find(peer);
    if (found != impl_->peers.end())
        found->second->set_delay(delay);
}

void Server::keep_everything(PeerId peer) {
    const auto found = impl_->peers.find(peer);
    if (found != impl_->peers.end())
        found->second->keep_everything();
}

bool Server::is_behind(PeerId peer, StreamId stream) const {
    const auto found = impl_->peers.find(peer);
    return found != impl_->peers.end() && found->second->is_behind(stream);
}

SendingFigures Server::take_figures(PeerId peer) {
    const auto found = impl_->peers.find(peer);
    return found == impl_->peers.end() ? SendingFigures{} : found->second->take_figures();
}

void Server::close(PeerId peer, const std::string& why) {
    const auto found = impl_->peers.find(peer);
    if (found == impl_->peers.end())
        return;
    const auto connection = found->second;
    connection->close(why);
}

void Server::drop(PeerId peer, const std::string& why) {
    const auto found = impl_->peers.find(peer);
    if (found == impl_->peers.end())
        return;
    const auto connection = found->second;
    connection->end(why);
}

}  // namespace theatron::net
