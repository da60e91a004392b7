// SPDX-License-Identifier: Apache-2.0
// The link that a host prints and a participant opens:
// https://HOST:PORT/#join=TOKEN&cert=FINGERPRINT&role=ROLE&until=TIME
//
// A browser never sends the part behind '#' to a server, so the same link can be
// opened in a browser.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace theatron::net {

struct Link {
    std::string host;  // a name or an address; IPv6 without brackets
    std::uint16_t port = 0;
    std::string token;        // the permission to join
    std::string fingerprint;  // SHA-256 of the host's certificate, 64 hex digits
    // For people who read the link; the host decides. Empty: not in the link.
    std::string role = {}, until = {};
};

std::string format_link(const Link& link);

// "HOST:PORT" for sentences, URLs and HTTP; IPv6 in brackets.
std::string host_and_port(std::string_view host, std::uint16_t port);
std::string host_and_port(const Link& link);

// Throws Error with one sentence about the problem, which does not contain the token.
Link parse_link(std::string_view text);

// True if a link can name this host: a DNS name, an IPv4 address, or an IPv6 address without
// brackets.
bool can_be_linked(std::string_view host);

// "ADDRESS:PORT", "[IPV6]:PORT" or ":PORT"; port 0 lets the system choose.
struct Endpoint {
    std::string address = "0.0.0.0";
    std::uint16_t port = 0;
};

// Throws Error with one sentence about the problem.
Endpoint parse_endpoint(std::string_view text);

}  // namespace theatron::net
