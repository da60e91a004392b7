// SPDX-License-Identifier: Apache-2.0
#include "net/server.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http.hpp>
#include <map>

#include "base/error.h"
#include "net/connection.h"

namespace theatron::net {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;

// More connections than this at once are not accepted; a room holds fewer people.
constexpr std::size_t max_connections = 128;

constexpr const char* plain_answer = "This is a Theatron host. Join it with: theatron join LINK\n";

}  // namespace

struct Server::Impl {
    asio::io_context io{1};
    asio::ssl::context tls{asio::ssl::context::tls_server};
    tcp::acceptor acceptor{io};
    asio::steady_timer timer{io};
    Handler handler;
    std::map<PeerId, std::shared_ptr<Connection>> peers;
    std::uint32_t next_peer = 1;
    std::size_t handshakes = 0;

    struct Handshake;
    void accept();
    void tick();
    void open(WebSocket socket, const std::string& address);
};

// From an accepted socket to an open WebSocket, or to nothing.
struct Server::Impl::Handshake : std::enable_shared_from_this<Handshake> {
    Handshake(Impl& s, tcp::socket accepted) : server(s), stream(std::move(accepted), s.tls) {
        ++server.handshakes;
        beast::error_code error;
        auto& lowest = beast::get_lowest_layer(stream);
        const auto endpoint = lowest.socket().remote_endpoint(error);
        address = error ? "unknown" : endpoint.address().to_string();
        tune_socket(lowest.socket());
        lowest.expires_after(std::chrono::seconds(10));
    }
    ~Handshake() { --server.handshakes; }

    void start() {
        stream.async_handshake(asio::ssl::stream_base::server,
                               [self = shared_from_this()](beast::error_code error) {
                                   if (!error)
                                       self->read_request();
                               });
    }

    void read_request() {
        parser.header_limit(8 * 1024);
        parser.body_limit(0);
        http::async_read(stream, buffer, parser,
                         [self = shared_from_this()](beast::error_code error, std::size_t) {
                             if (error)
                                 return;
                             if (beast::websocket::is_upgrade(self->parser.get()))
                                 self->upgrade();
                             else
                                 self->answer();
                         });
    }

    void upgrade() {
        beast::get_lowest_layer(stream).expires_never();
        socket = std::make_unique<WebSocket>(std::move(stream));
        configure(*socket);
        socket->async_accept(parser.get(), [self = shared_from_this()](beast::error_code error) {
            if (!error)
                self->server.open(std::move(*self->socket), self->address);
        });
    }

    // A browser, or a curious colleague with curl.
    void answer() {
        const auto& request = parser.get();
        std::optional<HttpAnswer> own;
        if (server.handler.http)
            own = server.handler.http(
                {std::string(request.target()), std::string(request[http::field::authorization])});
        const HttpAnswer answer = own ? std::move(*own) : HttpAnswer{.body = plain_answer};
        response.result(unsigned(answer.status));
        response.set(http::field::content_type, answer.type);
        response.set(http::field::cache_control, "no-store");
        if (answer.status == 401)
            response.set(http::field::www_authenticate, "Bearer");
        response.keep_alive(false);
        response.body() = answer.body;
        response.prepare_payload();
        http::async_write(stream, response,
                          [self = shared_from_this()](beast::error_code, std::size_t) {
                              self->stream.async_shutdown([self](beast::error_code) {});
                          });
    }

    Impl& server;
    TlsStream stream;
    std::unique_ptr<WebSocket> socket;
    beast::flat_buffer buffer;
    http::request_parser<http::empty_body> parser;
    http::response<http::string_body> response;
    std::string address;
};

void Server::Impl::accept() {
    acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
        if (error == asio::error::operation_aborted)
            return;
        if (!error && peers.size() + handshakes < max_connections)
            std::make_shared<Handshake>(*this, std::move(socket))->start();
        accept();
    });
}

void Server::Impl::tick() {
    timer.expires_after(std::chrono::milliseconds(100));
    timer.async_wait([this](beast::error_code error) {
        if (error)
            return;
        if (handler.tick)
            handler.tick();
        tick();
    });
}

void Server::Impl::open(WebSocket socket, const std::string& address) {
    const PeerId peer{next_peer++};
    Connection::Events events;
    events.control = [this, peer](ByteView bytes) { handler.control(peer, bytes); };
    events.media = [this, peer](ByteView bytes) { handler.media(peer, bytes); };
    events.closed = [this, peer](const std::string& why) {
        peers.erase(peer);
        handler.closed(peer, why);
    };
    events.now = handler.now;
    const auto connection = std::make_shared<Connection>(std::move(socket), std::move(events));
    peers[peer] = connection;
    handler.connected(peer, address);
    connection->start();
}

Server::Server(const Endpoint& endpoint, const Certificate& certificate, Handler handler)
    : impl_(std::make_unique<Impl>()) {
    impl_->handler = std::move(handler);
    impl_->tls.use_certificate_chain(asio::buffer(certificate.certificate_pem));
    impl_->tls.use_private_key(asio::buffer(certificate.private_key_pem), asio::ssl::context::pem);
    SSL_CTX_set_min_proto_version(impl_->tls.native_handle(), TLS1_3_VERSION);

    beast::error_code error;
    const auto address = asio::ip::make_address(endpoint.address, error);
    if (error)
        throw Error(
            "'" + endpoint.address +
            "' is no address of this machine; write an IP address such as 0.0.0.0 or 127.0.0.1.");
    const tcp::endpoint where(address, endpoint.port);
    const std::string text = endpoint.address + ":" + std::to_string(endpoint.port);
    impl_->acceptor.open(where.protocol(), error);
    if (!error)
        impl_->acceptor.set_option(asio::socket_base::reuse_address(true), error);
    if (!error)
        impl_->acceptor.bind(where, error);
    if (!error)
        impl_->acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error == asio::error::address_in_use)
        throw Error("Port " + std::to_string(endpoint.port) + " on " + endpoint.address +
                    " is in use; stop the other program or choose another port with --listen.");
    if (error)
        throw Error("Cannot listen on " + text + ": " + error.message() + ".");
}

Server::~Server() {
    // Connections hold handlers that refer to this server: end them first.
    impl_->peers.clear();
}

std::uint16_t Server::port() const {
    return impl_->acceptor.local_endpoint().port();
}

void Server::run() {
    impl_->accept();
    impl_->tick();
    impl_->io.run();
}

void Server::stop() {
    impl_->io.stop();
}

void Server::post(std::function<void()> work) {
    asio::post(impl_->io, std::move(work));
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

void Server::acknowledge(PeerId peer, std::uint64_t media_bytes) {
    const auto found = impl_->peers.find(peer);
    if (found == impl_->peers.end())
        return;
    const auto connection = found->second;
    connection->acknowledge(media_bytes);
}

void Server::set_ceiling(PeerId peer, double bytes_per_second) {
    const auto found = impl_->peers.find(peer);
    if (found == impl_->peers.end())
        return;
    const auto connection = found->second;
    connection->set_ceiling(bytes_per_second);
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

}  // namespace theatron::net
