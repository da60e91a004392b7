// SPDX-License-Identifier: Apache-2.0
// The proxy through which a program reaches hosts outside its own network, as the environment of
// most programs names it: HTTPS_PROXY, and NO_PROXY for hosts that are reached without it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace theatron::net {

struct OutgoingProxy {
    std::string host;  // a name or an address; IPv6 without brackets
    std::uint16_t port = 0;
    std::string credentials;  // "NAME:PASSWORD", or empty

    std::string where() const;  // "HOST:PORT", without the credentials
    bool operator==(const OutgoingProxy&) const = default;
};

// The two variables; empty where they are not set.
struct ProxySettings {
    std::string https_proxy;  // "http://[NAME:PASSWORD@]HOST[:PORT]", without a port 3128; the
                              // scheme may be absent
    std::string no_proxy;     // "*", or names, addresses and networks ("10.0.0.0/8") with commas
};

// The variables of this process; names in small letters come first, as they do for curl.
ProxySettings proxy_settings_of_environment();

// The proxy for a host, a name or an address as in a link; nullopt: it is reached without one.
// Loopback addresses and `localhost` always are. An entry of no_proxy means the name and all below
// it, with or without a dot before it. Throws Error with one sentence, without the credentials,
// about a setting that cannot be used.
std::optional<OutgoingProxy> proxy_for(std::string_view host, const ProxySettings& settings);

// The request for a tunnel to this host (RFC 9110, 9.3.6, and RFC 7617 for the credentials).
std::string tunnel_request(const OutgoingProxy& proxy, std::string_view host, std::uint16_t port);

// The names of the schemes of one Proxy-Authenticate field (RFC 9110, 11.6.1), without their
// parameters, as the proxy writes them: {"Negotiate", "Basic"}. Any bytes are allowed.
std::vector<std::string> offered_schemes(std::string_view field);

}  // namespace theatron::net
