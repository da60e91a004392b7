// SPDX-License-Identifier: Apache-2.0
// Networks of IPv4 addresses, as "10.2.0.0/16". Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace theatron::session {

// In one spelling: four decimal numbers without leading zeros.
std::optional<std::uint32_t> parse_ipv4(std::string_view text);

struct Ipv4Network {
    std::uint32_t address = 0;
    int prefix = 32;  // leading bits that its addresses share, 0 to 32
    bool contains(std::uint32_t other) const {
        return prefix == 0 || ((address ^ other) >> (32 - prefix)) == 0;
    }
};

// An address alone is the network of this address.
std::optional<Ipv4Network> parse_ipv4_network(std::string_view text);

}  // namespace theatron::session
