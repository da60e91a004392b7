// SPDX-License-Identifier: Apache-2.0
#include "net/link.h"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>

#include "base/error.h"

namespace theatron::net {
namespace {

constexpr std::string_view scheme = "https://";

// Splits "host:port" at the last colon and takes brackets off an IPv6 address.
bool split_host_port(std::string_view text, std::string& host, std::uint16_t& port) {
    const auto colon = text.rfind(':');
    if (colon == std::string_view::npos)
        return false;
    const std::string_view digits = text.substr(colon + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
    if (error != std::errc{} || end != digits.data() + digits.size())
        return false;
    std::string_view name = text.substr(0, colon);
    if (name.starts_with('[') && name.ends_with(']'))
        name = name.substr(1, name.size() - 2);
    else if (name.find(':') != std::string_view::npos)
        return false;
    host = name;
    return true;
}

bool is_hex_digest(std::string_view text) {
    return text.size() == 64 && std::all_of(text.begin(), text.end(), [](char c) {
               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
           });
}

// The part of a link that an error message may show: the text after host and port is secret, and a
// long word that is no address may be secret too.
std::string without_secrets(std::string_view text) {
    constexpr std::size_t shown_characters = 80, word_characters = 15;
    std::string_view shown = text.substr(0, text.find('#'));
    for (const std::string_view secret : {"join=", "token=", "cert="})
        shown = shown.substr(0, shown.find(secret));
    if (shown.size() > word_characters && shown.find_first_of(".:/") == std::string_view::npos)
        shown = {};
    shown = shown.substr(0, shown_characters);
    std::string result;
    for (const char c : shown)
        result += c >= ' ' && c <= '~' ? c : '?';
    return shown.size() < text.size() ? result + "..." : result;
}

}  // namespace

std::string format_link(const Link& link) {
    return std::string(scheme) + host_and_port(link) + "/#join=" + link.token +
           "&cert=" + link.fingerprint + (link.role.empty() ? "" : "&role=" + link.role) +
           (link.until.empty() ? "" : "&until=" + link.until);
}

std::string host_and_port(std::string_view host, std::uint16_t port) {
    const bool is_ipv6 = host.find(':') != host.npos;
    return (is_ipv6 ? "[" + std::string(host) + "]" : std::string(host)) + ":" +
           std::to_string(port);
}

std::string host_and_port(const Link& link) {
    return host_and_port(link.host, link.port);
}

bool can_be_linked(std::string_view host) {
    constexpr std::string_view of_names =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_";
    constexpr std::size_t dns_name_characters = 253;  // at most; RFC 1035
    if (host.find(':') != host.npos) {
        in6_addr address{};
        return host.find('\0') == host.npos &&
               inet_pton(AF_INET6, std::string(host).c_str(), &address) == 1;
    }
    return !host.empty() && host.size() <= dns_name_characters &&
           host.find_first_not_of(of_names) == host.npos && host.front() != '.' &&
           host.front() != '-';
}

Link parse_link(std::string_view text) {
    const auto wrong = [&](const std::string& why) {
        return Error("The link '" + without_secrets(text) + "' " + why +
                     "; copy the whole link that the host printed.");
    };
    if (!text.starts_with(scheme))
        throw wrong("does not begin with https://");
    std::string_view rest = text.substr(scheme.size());
    const auto slash = rest.find('/');
    const auto hash = rest.find('#');
    Link link;
    if (!split_host_port(rest.substr(0, std::min(slash, hash)), link.host, link.port) ||
        link.host.empty() || link.port == 0)
        throw wrong("names no host and port");

    std::string_view fragment = hash == std::string_view::npos ? "" : rest.substr(hash + 1);
    while (!fragment.empty()) {
        const auto end = fragment.find('&');
        const std::string_view part = fragment.substr(0, end);
        if (part.starts_with("join="))
            link.token = part.substr(5);
        else if (part.starts_with("cert="))
            link.fingerprint = part.substr(5);
        else if (part.starts_with("role="))
            link.role = part.substr(5);
        else if (part.starts_with("until="))
            link.until = part.substr(6);
        fragment = end == std::string_view::npos ? "" : fragment.substr(end + 1);
    }
    if (link.token.empty())
        throw wrong("carries no join token");
    if (!is_hex_digest(link.fingerprint))
        throw wrong("carries no certificate fingerprint of 64 hex digits");
    return link;
}

Endpoint parse_endpoint(std::string_view text) {
    Endpoint endpoint;
    std::string host;
    if (!split_host_port(text, host, endpoint.port))
        throw Error("'" + std::string(text) +
                    "' is no address to listen on; write ADDRESS:PORT, for example 0.0.0.0:4400 or "
                    "[::]:4400.");
    if (!host.empty())
        endpoint.address = host;
    return endpoint;
}

}  // namespace theatron::net
