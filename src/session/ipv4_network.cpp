// SPDX-License-Identifier: Apache-2.0
#include "session/ipv4_network.h"

#include <charconv>

namespace theatron::session {
namespace {

// A decimal number up to `most` without leading zeros, the whole text.
std::optional<std::uint32_t> parse_number(std::string_view text, std::uint32_t most) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value > most ||
        (text.size() > 1 && text.front() == '0'))
        return std::nullopt;
    return value;
}

}  // namespace

std::optional<std::uint32_t> parse_ipv4(std::string_view text) {
    std::uint32_t address = 0;
    for (int part = 0; part < 4; ++part) {
        const std::size_t end = part < 3 ? text.find('.') : text.size();
        if (end == std::string_view::npos)
            return std::nullopt;
        const auto number = parse_number(text.substr(0, end), 255);
        if (!number)
            return std::nullopt;
        address = address << 8 | *number;
        text.remove_prefix(part < 3 ? end + 1 : end);
    }
    return address;
}

std::optional<Ipv4Network> parse_ipv4_network(std::string_view text) {
    const std::size_t slash = text.find('/');
    const auto address = parse_ipv4(text.substr(0, slash));
    const auto prefix = slash == std::string_view::npos ? std::optional<std::uint32_t>(32)
                                                        : parse_number(text.substr(slash + 1), 32);
    if (!address || !prefix)
        return std::nullopt;
    return Ipv4Network{*address, int(*prefix)};
}

}  // namespace theatron::session
