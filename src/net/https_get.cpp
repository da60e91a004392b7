// SPDX-License-Identifier: Apache-2.0
#include "net/https_get.h"

#include <openssl/ssl.h>
#include <boost/beast/http.hpp>

#include "base/error.h"
#include "net/certificate.h"
#include "net/connection.h"
#include "net/way_to_host.h"

namespace theatron::net {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

constexpr std::size_t max_answer = std::size_t(16) << 20;

// One request from beginning to end.
struct Exchange {
    const Link& link;
    Duration timeout;
    asio::io_context io{1};
    asio::ssl::context tls{asio::ssl::context::tls_client};
    TlsStream stream{io, tls};
    std::optional<OutgoingProxy> proxy;
    WayToHost way;
    http::request<http::empty_body> request;
    http::response_parser<http::string_body> answer;
    beast::flat_buffer buffer;
    std::string problem = "no answer came in time";

    Exchange(const Link& l, const std::string& target, Duration t)
        : link(l),
          timeout(t),
          proxy(proxy_for(l.host, proxy_settings_of_environment())),
          way(beast::get_lowest_layer(stream), l.host, l.port, proxy) {
        SSL_CTX_set_min_proto_version(tls.native_handle(), TLS1_3_VERSION);
        // The pinned fingerprint is checked by hand after the handshake.
        tls.set_verify_mode(asio::ssl::verify_none);
        request.method(http::verb::get);
        request.target(target);
        request.version(11);
        request.set(http::field::host, host_and_port(link));
        request.set(http::field::authorization, "Bearer " + link.token);
        request.set(http::field::connection, "close");
        answer.body_limit(max_answer);
    }

    // Continues with `next`, or ends with the error.
    template <class Next>
    auto then(Next next) {
        return [this, next](beast::error_code error, auto&&...) {
            if (error)
                problem = error.message();
            else
                next();
        };
    }

    void run() {
        way.open(timeout, [this](const std::optional<Unreached>& unreached) {
            if (unreached)
                problem = text_of(*unreached, proxy);
            else
                handshake();
        });
        io.run_for(timeout + 1s);
    }
    void handshake() {
        stream.async_handshake(asio::ssl::stream_base::client, then([this] {
                                   if (shows_the_right_certificate())
                                       ask();
                                   else
                                       problem = wrong_certificate();
                               }));
    }
    bool shows_the_right_certificate() {
        return equal_secrets(fingerprint_of_peer(stream.native_handle()), link.fingerprint);
    }
    std::string wrong_certificate() const {
        return proxy ? "another certificate than the link names comes through the proxy " +
                           proxy->where() + ", which may open encrypted connections"
                     : "it shows another certificate than the link names";
    }
    void ask() {
        http::async_write(stream, request, then([this] {
                              http::async_read(stream, buffer, answer,
                                               then([this] { problem.clear(); }));
                          }));
    }
};

}  // namespace

HttpsAnswer https_get(const Link& link, const std::string& target, Duration timeout) {
    Exchange exchange(link, target, timeout);
    exchange.run();
    if (!exchange.problem.empty())
        throw Error("The host at " + host_and_port(link) + " does not answer: " + exchange.problem +
                    ".");
    return {int(exchange.answer.get().result_int()), exchange.answer.get().body()};
}

}  // namespace theatron::net
