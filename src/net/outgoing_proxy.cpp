// SPDX-License-Identifier: Apache-2.0
#include "net/outgoing_proxy.h"

#include <openssl/evp.h>
#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/network_v4.hpp>
#include <boost/asio/ip/network_v6.hpp>
#include <charconv>
#include <cstdlib>

#include "base/error.h"
#include "base/small_letters.h"
#include "net/link.h"

namespace theatron::net {
namespace {

namespace ip = boost::asio::ip;

constexpr std::uint16_t usual_port = 3128;
constexpr const char* how = "; it is written http://PROXY:PORT or http://NAME:PASSWORD@PROXY:PORT.";

std::string_view without_blanks(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    return first == std::string_view::npos
               ? std::string_view()
               : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::optional<ip::address> address_of(std::string_view text) {
    boost::system::error_code none;
    const ip::address address = ip::make_address(std::string(text), none);
    return none ? std::nullopt : std::optional(address);
}

// "%41" is "A", as in each URL.
std::string without_percents(std::string_view text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        if (text[i] == '%' && i + 2 < text.size() &&
            std::from_chars(text.data() + i + 1, text.data() + i + 3, value, 16).ptr ==
                text.data() + i + 3) {
            plain += char(value);
            i += 2;
        } else {
            plain += text[i];
        }
    }
    return plain;
}

bool is_in_network(const ip::address& address, const std::string& network) {
    boost::system::error_code none;
    if (address.is_v4()) {
        const ip::network_v4 wanted = ip::make_network_v4(network, none);
        return !none && (address.to_v4().to_uint() & wanted.netmask().to_uint()) ==
                            wanted.network().to_uint();
    }
    const ip::network_v6 wanted = ip::make_network_v6(network, none);
    return !none &&
           ip::network_v6(address.to_v6(), wanted.prefix_length()).network() == wanted.network();
}

bool is_exempt(std::string_view host, std::string_view entry) {
    const std::string wanted = in_small_letters(without_blanks(entry));
    if (wanted.empty())
        return false;
    if (wanted == "*")
        return true;
    if (const auto address = address_of(host)) {
        if (wanted.find('/') != std::string::npos)
            return is_in_network(*address, wanted);
        const bool has_brackets = wanted.front() == '[' && wanted.back() == ']';
        return address_of(has_brackets ? wanted.substr(1, wanted.size() - 2) : wanted) == address;
    }
    const std::string name = in_small_letters(host);
    const std::string_view domain = std::string_view(wanted).substr(wanted.front() == '.' ? 1 : 0);
    return name == domain || (name.size() > domain.size() && name.ends_with(domain) &&
                              name[name.size() - domain.size() - 1] == '.');
}

bool is_this_computer(std::string_view host) {
    const auto address = address_of(host);
    return address ? address->is_loopback() || address->is_unspecified()
                   : in_small_letters(host) == "localhost";
}

OutgoingProxy parse(std::string_view text) {
    if (const auto scheme = text.find("://"); scheme != std::string_view::npos) {
        if (in_small_letters(text.substr(0, scheme)) != "http")
            throw Error("HTTPS_PROXY names a proxy of a kind that is not supported" +
                        std::string(how));
        text.remove_prefix(scheme + 3);
    }
    OutgoingProxy proxy;
    if (const auto at = text.rfind('@'); at != std::string_view::npos) {
        proxy.credentials = without_percents(text.substr(0, at));
        text.remove_prefix(at + 1);
    }
    text = text.substr(0, text.find('/'));
    std::string_view port;
    if (text.starts_with('[')) {
        const auto end = text.find(']');
        if (end == std::string_view::npos)
            throw Error("HTTPS_PROXY has an address without its ']'" + std::string(how));
        proxy.host = text.substr(1, end - 1);
        port = text.substr(end + 1);
    } else {
        proxy.host = text.substr(0, text.find(':'));
        port = text.substr(proxy.host.size());
    }
    proxy.port = usual_port;
    if (!port.empty()) {
        const char* end = port.data() + port.size();
        const auto [last, error] = std::from_chars(port.data() + 1, end, proxy.port);
        if (port.front() != ':' || error != std::errc() || last != end || proxy.port == 0)
            throw Error("HTTPS_PROXY has no port from 1 to 65535" + std::string(how));
    }
    if (proxy.host.empty())
        throw Error("HTTPS_PROXY names no proxy" + std::string(how));
    return proxy;
}

std::string variable(const char* small, const char* capital) {
    for (const char* name : {small, capital})
        if (const char* value = std::getenv(name); value && *value != '\0')
            return value;
    return "";
}

// Splits at commas that stand outside of quotes.
std::vector<std::string_view> elements_of(std::string_view list) {
    std::vector<std::string_view> elements;
    std::size_t begin = 0;
    bool is_quoted = false;
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (list[i] == '"')
            is_quoted = !is_quoted;
        else if (list[i] == '\\' && is_quoted)
            ++i;  // whatever is behind it
        else if (list[i] == ',' && !is_quoted) {
            elements.push_back(list.substr(begin, i - begin));
            begin = i + 1;
        }
    }
    elements.push_back(list.substr(begin));
    return elements;
}

}  // namespace

std::string OutgoingProxy::where() const {
    return host_and_port(host, port);
}

ProxySettings proxy_settings_of_environment() {
    return {variable("https_proxy", "HTTPS_PROXY"), variable("no_proxy", "NO_PROXY")};
}

std::optional<OutgoingProxy> proxy_for(std::string_view host, const ProxySettings& settings) {
    const std::string_view wanted = without_blanks(settings.https_proxy);
    if (wanted.empty() || is_this_computer(host))
        return std::nullopt;
    for (std::string_view rest = settings.no_proxy; !rest.empty();) {
        const std::string_view entry = rest.substr(0, rest.find(','));
        if (is_exempt(host, entry))
            return std::nullopt;
        rest.remove_prefix(std::min(rest.size(), entry.size() + 1));
    }
    return parse(wanted);
}

std::string tunnel_request(const OutgoingProxy& proxy, std::string_view host, std::uint16_t port) {
    const std::string target = host_and_port(host, port);
    std::string request = "CONNECT " + target + " HTTP/1.1\r\nHost: " + target + "\r\n";
    if (!proxy.credentials.empty()) {
        std::string encoded((proxy.credentials.size() + 2) / 3 * 4 + 1, '\0');
        encoded.resize(std::size_t(
            EVP_EncodeBlock(reinterpret_cast<unsigned char*>(encoded.data()),
                            reinterpret_cast<const unsigned char*>(proxy.credentials.data()),
                            int(proxy.credentials.size()))));
        request += "Proxy-Authorization: Basic " + encoded + "\r\n";
    }
    return request + "\r\n";
}

std::vector<std::string> offered_schemes(std::string_view field) {
    // RFC 9110, 5.6.2.
    constexpr std::string_view of_tokens =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789!#$%&'*+-.^_`|~";
    std::vector<std::string> schemes;
    for (const std::string_view each : elements_of(field)) {
        const std::string_view element = without_blanks(each);
        const std::size_t end = std::min(element.find_first_not_of(of_tokens), element.size());
        // "NAME = VALUE" is a parameter of the scheme before it.
        const std::string_view rest = without_blanks(element.substr(end));
        const bool is_separated = rest.empty() || element[end] == ' ' || element[end] == '\t';
        if (end > 0 && is_separated && !rest.starts_with('='))
            schemes.emplace_back(element.substr(0, end));
    }
    return schemes;
}

}  // namespace theatron::net
