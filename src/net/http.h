// SPDX-License-Identifier: Apache-2.0
// HTTP requests without a WebSocket, from browsers and monitoring systems, and their parsing.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace theatron::net {

struct HttpRequest {
    std::string target;                // path and query
    std::string authorization;         // the header Authorization
    std::string accept_encoding = {};  // the header Accept-Encoding
};
struct HttpAnswer {
    int status = 200;
    std::string type = "text/plain; charset=utf-8";
    std::string body;
    // Sent instead of `body`, without a copy.
    std::shared_ptr<const std::string> file = nullptr;
    // Further headers. Without Cache-Control among them nobody may keep the answer.
    std::vector<std::pair<std::string, std::string>> headers = {};
};

// The part of a target before '?', not decoded.
std::string_view path_of(std::string_view target);

// The first value of a parameter of the query, with "%2B" and "+" decoded as browsers encode
// them; empty if there is none. May contain any bytes. Safe for untrusted input.
std::string query_value(std::string_view target, std::string_view parameter);

// The token that a request shows: "Authorization: Bearer TOKEN", or token=TOKEN in the query.
std::string shown_token(const HttpRequest& request);

// True if the answer says that the token which the request shows, wherever it stands, is wrong.
bool is_wrong_guess(const HttpRequest& request, const HttpAnswer& answer);

// True if the header Accept-Encoding allows this coding by name. Safe for untrusted input.
bool accepts_encoding(std::string_view accept_encoding, std::string_view coding);

// True if a page of `origin` (that header; empty: no browser) may connect to `host` (that header).
// Only pages that this host itself served may.
bool is_own_origin(std::string_view origin, std::string_view host);

// The name and port under which people reach a host, through a proxy or directly.
struct PublicName {
    std::string name;  // lower case, a DNS name or an IPv4 address
    std::uint16_t port = 0;
};

// "NAME" or "NAME:PORT". Throws Error with one sentence about the problem.
PublicName parse_public_name(std::string_view text, std::uint16_t usual_port);

// The origin of the pages that are served under this name.
std::string origin_of(const PublicName& name);

// True if the header Host means the host with this public name: by that name, as localhost or by an
// IP address, with any port. Only those: another name that leads here may be that of a page which
// tries to pass for the host's own (DNS rebinding). Safe for untrusted input.
bool is_named(std::string_view host, std::string_view public_name);

}  // namespace theatron::net
