// SPDX-License-Identifier: Apache-2.0
#include "session/direct_addresses.h"

#include <algorithm>

namespace theatron::session {
namespace {

enum class Kind : std::uint8_t {
    none,  // nobody's alone: this network, multicast, reserved, broadcast
    loopback,
    link,  // of a single link, without a router
    local,
    internet,
};

constexpr bool is_in(std::uint32_t address, std::uint32_t network, int bits) {
    return (address ^ network) >> (32 - bits) == 0;
}

constexpr Kind kind_of(std::uint32_t address) {
    if (is_in(address, 0, 8) || address >= 0xe0000000)
        return Kind::none;
    if (is_in(address, 0x7f000000, 8))
        return Kind::loopback;
    if (is_in(address, 0xa9fe0000, 16))
        return Kind::link;
    const bool is_local = is_in(address, 0x0a000000, 8) || is_in(address, 0xac100000, 12) ||
                          is_in(address, 0xc0a80000, 16) || is_in(address, 0x64400000, 10);
    return is_local ? Kind::local : Kind::internet;
}

Kind kind_of(const std::optional<std::uint32_t>& address) {
    return address ? kind_of(*address) : Kind::none;
}

bool is_near(const std::optional<std::uint32_t>& a, std::uint32_t b) {
    return a && is_in(*a, b, 16);
}

}  // namespace

std::optional<std::uint32_t> parse_ipv4(std::string_view text) {
    constexpr std::string_view mapped = "::ffff:";
    if (text.starts_with(mapped))
        text.remove_prefix(mapped.size());
    std::uint32_t address = 0;
    for (int part = 0; part < 4; ++part) {
        std::uint32_t value = 0;
        std::size_t digits = 0;
        while (digits < text.size() && digits < 3 && text[digits] >= '0' && text[digits] <= '9')
            value = 10 * value + std::uint32_t(text[digits++] - '0');
        if (digits == 0 || value > 255 || (digits > 1 && text.front() == '0'))
            return std::nullopt;
        text.remove_prefix(digits);
        if (part < 3) {
            if (!text.starts_with('.'))
                return std::nullopt;
            text.remove_prefix(1);
        }
        address = address << 8 | value;
    }
    return text.empty() ? std::optional(address) : std::nullopt;
}

std::string text_of_ipv4(std::uint32_t address) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8)
        text += (text.empty() ? "" : ".") + std::to_string(address >> shift & 255);
    return text;
}

std::vector<std::string> direct_addresses(const std::string& publisher,
                                          const std::vector<std::string>& offered,
                                          const std::string& receiver) {
    const auto from = parse_ipv4(publisher), to = parse_ipv4(receiver);
    const Kind from_kind = kind_of(from), to_kind = kind_of(to);
    const bool is_inside =
        to_kind == Kind::loopback || to_kind == Kind::link || to_kind == Kind::local;
    const bool is_behind_one_router = from_kind == Kind::internet && from == to;
    const auto may_be_used = [&](std::uint32_t address) {
        const bool is_seen = from == address;
        switch (kind_of(address)) {
            case Kind::none:
                return false;
            case Kind::loopback:
                return from_kind == Kind::loopback && to_kind == Kind::loopback;
            case Kind::link:
                return is_seen && is_inside;
            case Kind::local:
                return is_behind_one_router ||
                       (is_inside && (is_seen || is_near(from, address) ||
                                      (from_kind == Kind::loopback && is_near(to, address))));
            case Kind::internet:
                return is_seen;
        }
        return false;
    };
    std::vector<std::string> result;
    const auto add = [&](const std::optional<std::uint32_t>& address) {
        if (!address || !may_be_used(*address))
            return;
        std::string text = text_of_ipv4(*address);
        if (std::find(result.begin(), result.end(), text) == result.end())
            result.push_back(std::move(text));
    };
    add(from);
    for (const std::string& text : offered)
        add(parse_ipv4(text));
    return result;
}

}  // namespace theatron::session
