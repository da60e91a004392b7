// SPDX-License-Identifier: Apache-2.0
// The link that a host prints and a participant opens:
// https://HOST:PORT/#join=TOKEN&cert=FINGERPRINT
//
// The part behind '#' never travels to a server, so a browser can be given the
// same link.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace theatron::net {

struct Link {
    std::string host;  // a name or an address; IPv6 without brackets
    std::uint16_t port = 0;
    std::string token;        // shows that the bearer was invited
    std::string fingerprint;  // SHA-256 of the host's certificate, 64 hex digits
};

std::string format_link(const Link& link);

// Throws Error saying what is missing or wrong, without the link's token.
Link parse_link(std::string_view text);

// "ADDRESS:PORT", "[IPV6]:PORT" or ":PORT"; port 0 lets the system choose.
struct Endpoint {
    std::string address = "0.0.0.0";
    std::uint16_t port = 0;
};

// Throws Error saying what is wrong.
Endpoint parse_endpoint(std::string_view text);

}  // namespace theatron::net
