// SPDX-License-Identifier: Apache-2.0
#include "net/proxies.h"

#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <charconv>

#include "base/error.h"
#include "base/trimmed.h"

namespace theatron::net {
namespace {

namespace ip = boost::asio::ip;

constexpr unsigned address_bits = 128, mapped_bits = 96;  // the latter before an IPv4 address

// An address as proxies write it: some add quotes, brackets or a port.
std::string_view without_port(std::string_view text) {
    if (text.size() >= 2 && text.starts_with('"') && text.ends_with('"'))
        text = text.substr(1, text.size() - 2);
    if (text.starts_with('['))
        return text.substr(1, std::min(text.find(']'), text.size()) - 1);
    if (std::count(text.begin(), text.end(), ':') == 1)
        return text.substr(0, text.find(':'));
    return text;
}

}  // namespace

std::optional<Proxies::Bytes16> Proxies::parse(std::string_view text) {
    // A scope would be looked up among this machine's interfaces.
    if (text.find('%') != text.npos)
        return std::nullopt;
    boost::system::error_code error;
    const ip::address address = ip::make_address(std::string(text), error);
    if (error)
        return std::nullopt;
    return address.is_v6() ? address.to_v6().to_bytes()
                           : ip::make_address_v6(ip::v4_mapped, address.to_v4()).to_bytes();
}

Proxies::Proxies(const std::vector<std::string>& networks) {
    for (const std::string& text : networks) {
        const std::size_t slash = std::min(text.find('/'), text.size());
        const auto address = parse(std::string_view(text).substr(0, slash));
        const bool is_v4 = text.find(':') == text.npos;
        unsigned bits = is_v4 ? address_bits - mapped_bits : address_bits;
        const unsigned most = bits;
        bool is_right = address.has_value();
        if (slash < text.size()) {
            const char *begin = text.data() + slash + 1, *end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(begin, end, bits);
            is_right = is_right && error == std::errc{} && stop == end && bits <= most &&
                       bits >= least_network_bits;
        }
        if (!is_right)
            throw Error("'" + text +
                        "' is no address of a proxy; write an IP address or a network of at least "
                        "8 bits, for example 127.0.0.1 or 10.1.2.0/24.");
        networks_.push_back({*address, is_v4 ? bits + mapped_bits : bits});
    }
}

bool Proxies::contains(const Bytes16& address) const {
    return std::any_of(networks_.begin(), networks_.end(), [&](const Network& network) {
        for (unsigned bit = 0; bit < network.bits; ++bit) {
            const unsigned mask = 0x80u >> bit % 8;
            if ((address[bit / 8] ^ network.address[bit / 8]) & mask)
                return false;
        }
        return true;
    });
}

bool Proxies::contains(std::string_view address) const {
    const auto parsed = parse(address);
    return parsed && contains(*parsed);
}

std::optional<std::string> Proxies::client_of(std::string_view forwarded_for) const {
    while (true) {
        const std::size_t comma = forwarded_for.rfind(',');
        const bool is_first = comma == forwarded_for.npos;
        const auto address = parse(
            without_port(trimmed(is_first ? forwarded_for : forwarded_for.substr(comma + 1))));
        if (!address)
            return std::nullopt;
        if (is_first || !contains(*address)) {
            const ip::address_v6 six(*address);
            return six.is_v4_mapped() ? ip::make_address_v4(ip::v4_mapped, six).to_string()
                                      : six.to_string();
        }
        forwarded_for = forwarded_for.substr(0, comma);
    }
}

}  // namespace theatron::net
