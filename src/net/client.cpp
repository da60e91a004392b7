// SPDX-License-Identifier: Apache-2.0
#include "net/client.h"

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include "base/error.h"
#include "base/fault.h"
#include "net/certificate.h"
#include "net/connection.h"
#include "net/way_to_host.h"
#include "phrases/phrase.h"

namespace theatron::net {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;

}  // namespace

struct Client::Impl {
    Link link;
    Handler handler;
    Duration patience = std::chrono::seconds(10);
    asio::io_context io{1};
    asio::ssl::context tls{asio::ssl::context::tls_client};
    asio::steady_timer timer{io};
    std::unique_ptr<WebSocket> socket;
    bool directly = false, is_leaving = false;
    std::optional<OutgoingProxy> proxy;
    std::unique_ptr<WayToHost> way;
    std::shared_ptr<Connection> connection;
    End end;

    std::string where() const { return host_and_port(link); }

    void finish(const std::string& why, bool final = false) {
        end = {why, final};
        io.stop();
    }

    void connect() {
        try {
            if (!directly)
                proxy = proxy_for(link.host, proxy_settings_of_environment());
        } catch (const Error& wrong) {
            return finish(wrong.what(), true);
        }
        socket = std::make_unique<WebSocket>(io, tls);
        way = std::make_unique<WayToHost>(beast::get_lowest_layer(*socket), link.host, link.port,
                                          proxy);
        way->open(patience, [this](const std::optional<Unreached>& unreached) {
            if (unreached && unreached->what == Unreached::What::host_unknown)
                return finish(say(Phrase::host_unknown, link.host, unreached->because));
            if (unreached)
                return finish(
                    say(Phrase::no_host_answers_because, where(), text_of(*unreached, proxy)),
                    unreached->is_final());
            tune_socket(beast::get_lowest_layer(*socket).socket());
            set_receive_buffer(beast::get_lowest_layer(*socket).socket(), viewer_receive_buffer);
            handshake();
        });
    }

    void handshake() {
        SSL_set_tlsext_host_name(socket->next_layer().native_handle(), link.host.c_str());
        socket->next_layer().async_handshake(
            asio::ssl::stream_base::client, [this](beast::error_code error) {
                if (error)
                    return finish(say(Phrase::host_without_tls, where(), error.message()));
                // The pin takes the place of a certificate authority. Nothing has
                // been sent yet.
                const std::string shown = fingerprint_of_peer(socket->next_layer().native_handle());
                if (!equal_secrets(shown, link.fingerprint))
                    return finish(proxy ? say(Phrase::proxy_opens_tls, where(), proxy->where())
                                        : say(Phrase::other_certificate, where()),
                                  true);
                upgrade();
            });
    }

    void upgrade() {
        beast::get_lowest_layer(*socket).expires_never();
        configure(*socket);
        socket->async_handshake(where(), "/connection", [this](beast::error_code error) {
            if (error)
                return finish(say(Phrase::no_web_socket, where(), error.message()));
            Connection::Events events;
            events.control = handler.control;
            events.media = handler.media;
            events.state = handler.state;
            events.voice = handler.voice;
            events.closed = [this](const std::string& why) {
                if (is_leaving)
                    return io.stop();
                finish(say(Phrase::connection_ended, why));
            };
            events.now = handler.now;
            connection = std::make_shared<Connection>(
                std::move(*socket), wire::Unwrapper::Takes::everything, std::move(events));
            connection->start();
            handler.connected();
        });
    }

    void leave() {
        if (!connection)
            return io.stop();
        is_leaving = true;
        connection->close("left");
        timer.expires_after(Connection::max_farewell);
        timer.async_wait([this](beast::error_code) { io.stop(); });
    }

    void tick() {
        if (is_leaving)
            return;
        timer.expires_after(std::chrono::milliseconds(100));
        timer.async_wait([this](beast::error_code error) {
            if (error)
                return;
            if (connection) {
                connection->look();
                if (handler.tick)
                    handler.tick();
            }
            tick();
        });
    }
};

Client::Client(Link link, Handler handler) : impl_(std::make_unique<Impl>()) {
    impl_->link = std::move(link);
    impl_->handler = std::move(handler);
    // The pinned fingerprint is checked by hand after the handshake.
    impl_->tls.set_verify_mode(asio::ssl::verify_none);
    SSL_CTX_set_min_proto_version(impl_->tls.native_handle(), TLS1_3_VERSION);
}

Client::~Client() = default;

Client::End Client::run() {
    const bool ended = contain("net", [this] {
        impl_->connect();
        impl_->tick();
        impl_->io.run();
    });
    if (!ended)
        return {say(Phrase::connection_ended, say(Phrase::met_a_fault)), false};
    return impl_->end;
}

void Client::go_directly() {
    impl_->directly = true;
}

void Client::set_patience(Duration patience) {
    impl_->patience = patience;
}

void Client::stop() {
    impl_->io.stop();
}

void Client::leave() {
    post([impl = impl_.get()] { impl->leave(); });
}

void Client::post(std::function<void()> work) {
    asio::post(impl_->io, std::move(work));
}

void Client::end(const std::string& why) {
    impl_->finish(why);
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

void Client::send_control(ByteView control) {
    if (impl_->connection)
        impl_->connection->send_control(control);
}

}  // namespace theatron::net
