// SPDX-License-Identifier: Apache-2.0
#include "net/door.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/bind_executor.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http.hpp>
#include <map>
#include <optional>

#include "base/error.h"
#include "base/fault.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "base/thread_name.h"
#include "net/listen_address.h"
#include "net/places.h"

namespace theatron::net {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;

// Waiting handshakes are checked at this interval.
constexpr Duration handshake_pause = std::chrono::milliseconds(10);
// Lower priority than pictures, for machines with few cores.
constexpr int niceness = 5;

constexpr std::size_t discarded_at_once = std::size_t(8) << 10;

constexpr std::string_view websocket_path = "/connection";

constexpr char plain_http_answer[] =
    "HTTP/1.1 400 Bad Request\r\nContent-Type: text/plain; charset=utf-8\r\n"
    "Cache-Control: no-store\r\nConnection: close\r\n\r\n"
    "This port speaks only HTTPS; write https:// before the address.\n";

// A TLS connection begins with the byte 22, a request without TLS with the name of a method.
bool begins_http(char first) {
    return first >= 'A' && first <= 'Z';
}

std::string_view view(beast::string_view text) {
    return {text.data(), text.size()};
}

// All headers of this name as one.
std::string joined(const http::fields& headers, std::string_view name) {
    std::string result;
    const auto [begin, end] = headers.equal_range({name.data(), name.size()});
    for (auto header = begin; header != end; ++header)
        result += (result.empty() ? "" : ",") + std::string(view(header->value()));
    return result;
}

std::shared_ptr<asio::ssl::context> make_tls(const Certificate& certificate) {
    auto tls = std::make_shared<asio::ssl::context>(asio::ssl::context::tls_server);
    beast::error_code error;
    tls->use_certificate_chain(asio::buffer(certificate.certificate_pem), error);
    if (!error)
        tls->use_private_key(asio::buffer(certificate.private_key_pem), asio::ssl::context::pem,
                             error);
    if (error)
        throw Error("The certificate cannot be used for TLS (" + error.message() +
                    "); ask for one with a key of at least 2048 bits RSA or 256 bits ECDSA.");
    SSL_CTX_set_min_proto_version(tls->native_handle(), TLS1_3_VERSION);
    // Nobody resumes a TLS session here, so tickets would be sent for nothing.
    SSL_CTX_set_num_tickets(tls->native_handle(), 0);
    return tls;
}

void listen(tcp::acceptor& acceptor, const Endpoint& endpoint) {
    beast::error_code error;
    const tcp::endpoint where(listen_address(endpoint), endpoint.port);
    acceptor.open(where.protocol(), error);
    if (!error)
        acceptor.set_option(asio::socket_base::reuse_address(true), error);
    // Accepted sockets inherit it; later the window could not be made smaller.
    if (!error)
        acceptor.set_option(asio::socket_base::receive_buffer_size(Door::stranger_receive_buffer),
                            error);
    if (!error)
        acceptor.bind(where, error);
    if (!error)
        acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error)
        throw Error(listening_problem(endpoint, error));
}

}  // namespace

void require_free(const Endpoint& endpoint) {
    asio::io_context io;
    tcp::acceptor acceptor(io);
    listen(acceptor, endpoint);
}

struct Door::Impl {
    asio::io_context io{1};
    asio::io_context& inside;
    std::shared_ptr<asio::ssl::context> tls;  // of handshakes that begin now
    tcp::acceptor acceptor{io};
    asio::steady_timer accept_again{io}, handshakes_again{io};
    Access access;
    Events events;
    Places places;
    bool told_of_silent_proxy = false;

    class Stranger;
    std::map<Places::Id, std::shared_ptr<Stranger>> strangers;

    explicit Impl(asio::io_context& i) : inside(i) {}

    // Runs a completion handler on the door's thread, although sockets belong to `inside`.
    template <class Handler>
    auto here(Handler handler) {
        return asio::bind_executor(io.get_executor(), std::move(handler));
    }
    void accept();
    void take_in(tcp::socket socket);
    void begin_handshakes();
    void turn_away(Places::Id id, const std::string& why);
};

// One connection that is being accepted. Everything runs on the door's thread. A step that fails,
// also for lack of memory, ends the connection.
class Door::Impl::Stranger : public std::enable_shared_from_this<Stranger> {
public:
    Stranger(Impl& door, Places::Id id, tcp::socket socket, std::string address)
        : door_(door),
          id_(id),
          address_(std::move(address)),
          raw_(std::move(socket)),
          deadline_(door.io) {
        tune_socket(raw_);
    }

    const std::string& address() const { return address_; }

    // After `leave`, the door's list no longer holds this, but the caller does.
    void leave(const std::string& why) { door_.turn_away(id_, why); }

    template <class Work>
    void guarded(Work work) {
        const auto self = shared_from_this();
        if (!contain("net", work))
            leave("met a fault");
    }

    // The completion handler of an operation: runs `work` on success, else ends the connection.
    template <class Work>
    auto step(Work work) {
        return door_.here(
            [this, self = shared_from_this(), work](beast::error_code error, auto&&...) {
                if (gone_)
                    return;
                if (error)
                    return leave(error == websocket::error::message_too_big ? "said too much"
                                                                            : "broke off");
                guarded(work);
            });
    }

    // TLS is set up only after the first bytes have arrived.
    void start() {
        extend(request_deadline, "said too little in time");
        raw_.async_wait(tcp::socket::wait_read, step([this] {
                            beast::error_code error;
                            if (raw_.available(error) == 0 || error)
                                return leave("went away");
                            char first = 0;
                            raw_.receive(asio::buffer(&first, 1), tcp::socket::message_peek, error);
                            if (!error && begins_http(first))
                                return answer_plain_http();
                            door_.places.want_handshake(id_);
                            door_.begin_handshakes();
                        }));
    }

    // It is this connection's turn: see Places::next_handshake().
    void proceed() {
        if (has_request_)
            guarded([&] { decide(); });
        else
            handshake();
    }

    void handshake() {
        guarded([&] {
            stream_.emplace(std::move(raw_), *door_.tls);
            stream_->async_handshake(asio::ssl::stream_base::server,
                                     step([this] { read_request(); }));
        });
    }

    void close() {
        deadline_.cancel();
        beast::error_code ignored;
        socket().close(ignored);
    }

private:
    tcp::socket& socket() {
        return web_      ? beast::get_lowest_layer(*web_).socket()
               : stream_ ? beast::get_lowest_layer(*stream_).socket()
                         : raw_;
    }

    void extend(Duration time, const char* why) {
        deadline_.expires_after(time);
        deadline_.async_wait([self = shared_from_this(), why](beast::error_code error) {
            if (!error && !self->gone_)
                self->leave(why);
        });
    }

    // One sentence instead of a failed handshake. The rest of the request is read before the
    // connection closes, since unread bytes would destroy the answer on its way.
    void answer_plain_http() {
        asio::async_write(raw_, asio::buffer(plain_http_answer, sizeof(plain_http_answer) - 1),
                          step([this] {
                              beast::error_code ignored;
                              raw_.shutdown(tcp::socket::shutdown_send, ignored);
                              discard(raw_, "spoke HTTP without TLS");
                          }));
    }

    // Reads what still comes, then leaves: unread bytes would destroy the answer on its way.
    template <class Stream>
    void discard(Stream& stream, const char* why) {
        drop(stream, max_unread_bytes + 1, why, [this, why] { leave(why); });
    }

    // Reads this many bytes, drops them, and goes on with `then`; leaves if they break off.
    template <class Stream, class Then>
    void drop(Stream& stream, std::uint64_t left, const char* why, Then then) {
        incoming_.clear();
        if (left == 0)
            return then();
        stream.async_read_some(
            incoming_.prepare(std::size_t(std::min(left, std::uint64_t(discarded_at_once)))),
            door_.here([this, self = shared_from_this(), &stream, left, why, then](
                           beast::error_code error, std::size_t count) {
                if (gone_)
                    return;
                if (error)
                    return leave(why);
                guarded([&] { drop(stream, left - count, why, then); });
            }));
    }

    void read_request() {
        parser_.header_limit(max_request_bytes);
        // The library reads no body: take_post() drops the one of a request that may have it.
        parser_.skip(true);
        http::async_read_header(
            *stream_, incoming_, parser_,
            door_.here([this, self = shared_from_this()](beast::error_code error, std::size_t) {
                if (gone_)
                    return;
                if (error == http::error::header_limit)
                    return guarded([this] { answer_large_head(); });
                if (error)
                    return leave("broke off");
                guarded([this] {
                    has_request_ = true;
                    if (door_.access.proxies.contains(address_))
                        find_client();
                    else
                        decide();
                });
            }));
    }

    void answer_large_head() {
        extend(first_message_deadline, "said too much");
        refuse(
            {.status = 431,
             .body = "This request has more than " + std::to_string(max_request_bytes / 1024) +
                     " KiB of headers, which are mostly cookies of other services of the same "
                     "name. Delete the cookies of this site, or open it in a private window.\n"});
    }

    // An answer to a request of which more may come, which is not wanted.
    void refuse(HttpAnswer refusal) {
        answer(std::move(refusal), step([this] {
                   beast::error_code ignored;
                   socket().shutdown(tcp::socket::shutdown_send, ignored);
                   discard(*stream_, "said too much");
               }));
    }

    // Limits hold for the client of a proxy, not for the proxy.
    void find_client() {
        const auto client =
            door_.access.proxies.client_of(joined(parser_.get(), "X-Forwarded-For"));
        if (!client) {
            if (!std::exchange(door_.told_of_silent_proxy, true))
                log::warning("net", "the proxy names no client in X-Forwarded-For",
                             {{"proxy", address_}});
            return decide();
        }
        address_ = *client;
        if (const auto evicted = door_.places.act_for(id_, address_group(address_)))
            door_.turn_away(*evicted, "had to go for others");
        extend(first_message_deadline, "asked too often");
        door_.places.want_handshake(id_);
        door_.begin_handshakes();
    }

    HttpRequest asked_now() const {
        const auto& request = parser_.get();
        return {std::string(request.target()), std::string(request[http::field::authorization]),
                std::string(request[http::field::accept_encoding])};
    }

    void note_guess(const HttpRequest& asked, const HttpAnswer& answered) {
        if (is_wrong_guess(asked, answered))
            door_.places.note_wrong_token(address_group(address_), steady_now());
    }

    // False if nobody takes a body at this path.
    bool take_post() {
        const auto bytes = parser_.content_length();
        if (!door_.events.posted || !bytes || websocket::is_upgrade(parser_.get()))
            return false;
        const HttpRequest asked = asked_now();
        auto answered = door_.events.posted(asked, *bytes);
        if (!answered)
            return false;
        note_guess(asked, *answered);
        if (answered->status != 204)
            return refuse(std::move(*answered)), true;
        extend(body_deadline, "did not send its body in time");
        // It has shown a token: a participant's window measures what a participant gets.
        beast::error_code ignored;
        socket().set_option(asio::socket_base::receive_buffer_size(participant_receive_buffer),
                            ignored);
        answer_ = std::move(*answered);
        const std::uint64_t here = std::min(*bytes, std::uint64_t(incoming_.size()));
        drop(*stream_, *bytes - here, "broke off", [this] { answer(std::move(answer_)); });
        return true;
    }

    void decide() {
        extend(first_message_deadline, "did not join in time");
        const auto& request = parser_.get();
        const std::string_view host = view(request[http::field::host]);
        const auto& name = door_.access.name;
        if (name && !is_named(host, name->name))
            return answer(
                {.status = 421, .body = "This host has another name; open the link as it is.\n"});
        if (request.method() == http::verb::post && take_post())
            return;
        if (request.method() != http::verb::get && request.method() != http::verb::head)
            return answer({.status = 405,
                           .body = "Only GET and HEAD are answered here.\n",
                           .headers = {{"Allow", "GET, HEAD"}}});
        if (!websocket::is_upgrade(request)) {
            const HttpRequest asked = asked_now();
            HttpAnswer answered = door_.events.http(asked);
            note_guess(asked, answered);
            return answer(std::move(answered));
        }
        if (path_of(view(request.target())) != websocket_path)
            return answer({.status = 404, .body = "There is nothing here.\n"});
        const std::string_view origin = view(request[http::field::origin]);
        if (!is_own_origin(origin, host) && !(name && origin == origin_of(*name)))
            return answer({.status = 403, .body = "Pages of other hosts may not connect here.\n"});
        upgrade();
    }

    // For requests without a WebSocket, for example of a browser.
    void answer(HttpAnswer given) {
        answer(
            std::move(given), step([this] {
                stream_->async_shutdown(door_.here([self = shared_from_this()](beast::error_code) {
                    if (!self->gone_)
                        self->leave("");
                }));
            }));
    }

    template <class End>
    void answer(HttpAnswer answer, End end) {
        answer_ = std::move(answer);
        const std::string& body = answer_.file ? *answer_.file : answer_.body;
        if (body.size() > large_answer)
            extend(large_answer_deadline, "did not take its answer in time");
        response_.result(unsigned(answer_.status));
        response_.set(http::field::content_type, answer_.type);
        response_.set(http::field::cache_control, "no-store");
        response_.set("X-Content-Type-Options", "nosniff");
        if (answer_.status == 401)
            response_.set(http::field::www_authenticate, "Bearer");
        if (door_.access.insists_on_https)
            response_.set(http::field::strict_transport_security,
                          "max-age=" + std::to_string(std::int64_t(to_seconds(https_only))));
        for (const auto& [name, value] : answer_.headers)
            response_.set(name, value);
        response_.keep_alive(false);
        response_.body() = {body.data(), body.size()};
        response_.prepare_payload();
        serializer_.emplace(response_);
        if (parser_.get().method() == http::verb::head)
            http::async_write_header(*stream_, *serializer_, std::move(end));
        else
            http::async_write(*stream_, *serializer_, std::move(end));
    }

    void upgrade() {
        web_.emplace(std::move(*stream_));
        stream_.reset();
        // The deadline is kept here: timers of the socket would run on the other thread.
        web_->set_option(websocket::stream_base::timeout{websocket::stream_base::none(),
                                                         websocket::stream_base::none(), false});
        // Otherwise the library writes its name and version.
        web_->set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
            response.set(http::field::server, "Theatron");
        }));
        web_->read_message_max(wire::max_first_envelope_size);
        web_->async_accept(parser_.get(), step([this] { read_first(); }));
    }

    void read_first() {
        incoming_.clear();
        web_->async_read(incoming_, step([this] {
                             const auto data = incoming_.cdata();
                             wire::Unwrapper unwrapper(wire::Unwrapper::Takes::all_but_media);
                             const auto first = unwrapper.take(
                                 {static_cast<const std::byte*>(data.data()), data.size()});
                             if (!first || first->control.empty())
                                 return leave("sent what is no message");
                             enter(first->control);
                         }));
    }

    void enter(ByteView first) {
        auto visitor = std::make_shared<Visitor>(Visitor{
            std::move(*web_), address_, {first.begin(), first.end()}, door_.events.invited(first)});
        if (visitor->invited)
            door_.places.note_known(address_group(address_));
        else
            door_.places.note_wrong_token(address_group(address_), steady_now());
        gone_ = true;
        deadline_.cancel();
        asio::post(door_.inside, [&events = door_.events, visitor] {
            (void)contain("net", [&] { events.entered(std::move(*visitor)); });
        });
        door_.places.leave(id_);
        door_.strangers.erase(id_);
    }

    friend struct Door::Impl;
    Impl& door_;
    const Places::Id id_;
    std::string address_;
    bool gone_ = false;
    bool has_request_ = false;
    tcp::socket raw_;  // until the first byte; then the one or the other:
    std::optional<TlsStream> stream_;
    std::optional<WebSocket> web_;
    asio::steady_timer deadline_;
    beast::flat_buffer incoming_;
    http::request_parser<http::empty_body> parser_;
    HttpAnswer answer_;  // owns the body of:
    http::response<http::span_body<const char>> response_;
    std::optional<http::response_serializer<http::span_body<const char>>> serializer_;
};

void Door::Impl::turn_away(Places::Id id, const std::string& why) {
    const auto found = strangers.find(id);
    if (found == strangers.end())
        return;
    const auto stranger = found->second;
    stranger->gone_ = true;
    strangers.erase(found);
    places.leave(id);
    stranger->close();
    if (!why.empty())
        (void)contain("net", [&] { events.turned_away(stranger->address(), why); });
}

void Door::Impl::accept() {
    acceptor.async_accept(inside, [this](beast::error_code error, tcp::socket socket) {
        if (error == asio::error::operation_aborted)
            return;
        if (!error) {
            (void)contain("net", [&] { take_in(std::move(socket)); });
            return accept();
        }
        // No descriptors, or no memory for another: going round at once would not help.
        if (const auto id = places.next_to_go())
            turn_away(*id, "had to go, there are no more sockets");
        accept_again.expires_after(no_socket_pause);
        accept_again.async_wait([this](beast::error_code stopped) {
            if (!stopped)
                accept();
        });
    });
}

void Door::Impl::take_in(tcp::socket socket) {
    beast::error_code error;
    const auto endpoint = socket.remote_endpoint(error);
    if (error)
        return;
    const std::string address = endpoint.address().to_string();
    const auto entered = access.proxies.contains(address)
                             ? places.enter_of_proxy(address_group(address))
                             : places.enter(address_group(address));
    if (entered.evicted)
        turn_away(*entered.evicted, "had to go for others");
    try {
        const auto stranger =
            std::make_shared<Stranger>(*this, entered.id, std::move(socket), address);
        strangers[entered.id] = stranger;
        stranger->start();
    } catch (...) {
        strangers.erase(entered.id);
        places.leave(entered.id);
        throw;
    }
}

void Door::Impl::begin_handshakes() {
    while (const auto id = places.next_handshake(steady_now()))
        if (const auto found = strangers.find(*id); found != strangers.end())
            found->second->proceed();
    if (!places.handshakes_wait())
        return;
    handshakes_again.expires_after(handshake_pause);
    handshakes_again.async_wait([this](beast::error_code error) {
        if (!error)
            (void)contain("net", [this] { begin_handshakes(); });
    });
}

Door::Door(asio::io_context& inside, const Endpoint& endpoint, const Certificate& certificate,
           Access access, Events events)
    : impl_(std::make_unique<Impl>(inside)) {
    impl_->access = std::move(access);
    impl_->events = std::move(events);
    impl_->tls = make_tls(certificate);
    listen(impl_->acceptor, endpoint);
}

Door::~Door() = default;

std::uint16_t Door::port() const {
    return impl_->acceptor.local_endpoint().port();
}

void Door::set_certificate(const Certificate& certificate) {
    // Connections keep the context that they began with.
    asio::post(impl_->io, [impl = impl_.get(), tls = make_tls(certificate)] { impl->tls = tls; });
}

void Door::run() {
    name_this_thread("door");
    // On Linux this sets the priority of the calling thread only.
    setpriority(PRIO_PROCESS, id_t(gettid()), niceness);
    impl_->accept();
    // A handler that threw cost its own connection; the others go on.
    while (!contain("net", [this] { impl_->io.run(); })) {
    }
}

void Door::stop() {
    impl_->io.stop();
}

void Door::close_all() {
    beast::error_code ignored;
    impl_->acceptor.close(ignored);
    impl_->accept_again.cancel();
    impl_->handshakes_again.cancel();
    while (!impl_->strangers.empty())
        impl_->turn_away(impl_->strangers.begin()->first, "");
}

std::size_t Door::poll() {
    impl_->io.restart();
    return impl_->io.poll();
}

}  // namespace theatron::net
