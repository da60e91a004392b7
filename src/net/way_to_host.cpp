// SPDX-License-Identifier: Apache-2.0
#include "net/way_to_host.h"

#include <algorithm>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <iterator>
#include <string_view>
#include <vector>

#include "base/outside_text.h"
#include "phrases/phrase.h"

namespace theatron::net {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using What = Unreached::What;

struct WayToHost::Answer {
    beast::flat_buffer buffer;
    std::optional<http::response_parser<http::empty_body>> parser;
};

namespace {

Unreached sign_on_wanted(const http::fields& head) {
    std::vector<std::string> schemes;
    const auto [begin, end] = head.equal_range(http::field::proxy_authenticate);
    for (auto field = begin; field != end; ++field)
        std::ranges::copy(offered_schemes(std::string_view(field->value())),
                          std::back_inserter(schemes));
    const bool has_basic = std::ranges::any_of(
        schemes, [](const std::string& scheme) { return beast::iequals(scheme, "Basic"); });
    if (schemes.empty() || has_basic)
        return {What::proxy_wants_name, ""};
    std::string names;
    for (const std::string& scheme : schemes)
        names += (names.empty() ? "" : ", ") + scheme;
    return {What::proxy_wants_other_scheme, clean_text(names, 80)};
}

}  // namespace

std::string text_of(const Unreached& unreached, const std::optional<OutgoingProxy>& proxy) {
    const std::string where = proxy ? proxy->where() : "";
    switch (unreached.what) {
        case What::proxy_silent:
            return say(Phrase::proxy_silent, where, unreached.because);
        case What::proxy_wants_name:
            return say(Phrase::proxy_wants_name, where);
        case What::proxy_wants_other_scheme:
            return say(Phrase::proxy_wants_other_scheme, where, unreached.because);
        case What::proxy_refuses:
            return say(Phrase::proxy_refuses, where, unreached.because);
        case What::proxy_adds_data:
            return say(Phrase::proxy_adds_data, where, unreached.because);
        case What::host_unknown:
        case What::host_silent:
            break;
    }
    return unreached.because;
}

WayToHost::WayToHost(beast::tcp_stream& stream, std::string host, std::uint16_t port,
                     std::optional<OutgoingProxy> proxy)
    : stream_(stream),
      host_(std::move(host)),
      port_(port),
      proxy_(std::move(proxy)),
      resolver_(stream.get_executor()) {}

WayToHost::~WayToHost() = default;

void WayToHost::open(Duration patience, std::function<void(std::optional<Unreached>)> done) {
    patience_ = patience;
    done_ = std::move(done);
    // A proxy looks up the host's name itself.
    resolver_.async_resolve(
        proxy_ ? proxy_->host : host_, std::to_string(proxy_ ? proxy_->port : port_),
        [this](beast::error_code error, const tcp::resolver::results_type& found) {
            if (error == asio::error::operation_aborted)
                return;
            if (error)
                return done_(
                    Unreached{proxy_ ? What::proxy_silent : What::host_unknown, error.message()});
            connect(found);
        });
}

void WayToHost::connect(const tcp::resolver::results_type& found) {
    stream_.expires_after(patience_);
    stream_.async_connect(found, [this](beast::error_code error, const tcp::endpoint&) {
        if (error)
            return done_(
                Unreached{proxy_ ? What::proxy_silent : What::host_silent, error.message()});
        if (proxy_)
            ask_for_tunnel();
        else
            done_(std::nullopt);
    });
}

void WayToHost::ask_for_tunnel() {
    request_ = tunnel_request(*proxy_, host_, port_);
    asio::async_write(stream_, asio::buffer(request_),
                      [this](beast::error_code error, std::size_t) {
                          if (error)
                              return done_(Unreached{What::proxy_silent, error.message()});
                          answer_ = std::make_unique<Answer>();
                          read_answer();
                      });
}

void WayToHost::read_answer() {
    answer_->parser.emplace();
    answer_->parser->header_limit(max_answer);
    answer_->parser->skip(true);  // a tunnel has no body
    http::async_read_header(stream_, answer_->buffer, *answer_->parser,
                            [this](beast::error_code error, std::size_t) {
                                if (error)
                                    return done_(Unreached{What::proxy_silent, error.message()});
                                take_answer();
                            });
}

void WayToHost::take_answer() {
    const auto& head = answer_->parser->get();
    const unsigned code = head.result_int();
    // The final answer follows an interim one ("100 Continue"); nothing follows "101 Switching
    // Protocols", which nobody asked for.
    if (code / 100 == 1 && code != 101)
        return read_answer();
    if (code == 407)
        return done_(sign_on_wanted(head));
    if (code < 200 || code > 299)
        return done_(Unreached{What::proxy_refuses,
                               std::to_string(code) + " " +
                                   std::string(http::obsolete_reason(http::int_to_status(code)))});
    // The host speaks second in TLS, so nothing of it can have come yet.
    if (answer_->buffer.size() > 0)
        return done_(Unreached{What::proxy_adds_data, std::to_string(code)});
    done_(std::nullopt);
}

}  // namespace theatron::net
