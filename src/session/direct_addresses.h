// SPDX-License-Identifier: Apache-2.0
// The addresses at which a receiver may look for a publisher. A publisher can name any address; so
// only those are believed at which the host sees it, or that can lie in its own networks. Else it
// would send all receivers to machines of others.
//
// IPv4 only, as publishers listen. Pure functions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace theatron::session {

// Listeners have a port that the system has chosen; lower ones belong to services.
inline constexpr std::uint16_t least_direct_port = 1024;

// Four numbers up to 255 without needless zeros; also in the form ::ffff:10.0.0.5. Everything else,
// also shorter forms that some systems understand, is no address.
std::optional<std::uint32_t> parse_ipv4(std::string_view text);
std::string text_of_ipv4(std::uint32_t address);

// `publisher` and `receiver`: at which the host sees them; another text than an address: not known.
// `offered`: what the publisher names. The result has no address twice, first the one at which the
// host sees the publisher, if the receiver can reach that:
//   a loopback address only where both are on the host's machine;
//   one of private networks or of a single link only for a receiver that is not seen on the
//   internet, and only if the host sees the publisher there, or in a network with the same first 16
//   bits (if the publisher is on the host's machine: the receiver); or if both are seen at the same
//   address, behind one router;
//   another one only where the host sees the publisher; and never multicast or reserved ones.
std::vector<std::string> direct_addresses(const std::string& publisher,
                                          const std::vector<std::string>& offered,
                                          const std::string& receiver);

}  // namespace theatron::session
