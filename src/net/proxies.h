// SPDX-License-Identifier: Apache-2.0
// The proxies that a host trusts to say for whom they connect, in the header X-Forwarded-For.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace theatron::net {

// Does not change after its construction; any thread.
class Proxies {
public:
    // A wider network than these bits name is refused: everybody in it could take any address.
    static constexpr unsigned least_network_bits = 8;

    Proxies() = default;
    // Addresses and networks: "127.0.0.1", "10.1.2.0/24", "fd00::/64". Throws Error with one
    // sentence about the problem.
    explicit Proxies(const std::vector<std::string>& networks);

    bool empty() const { return networks_.empty(); }
    // True if this is the address of one of the proxies. `address` as Asio writes it.
    bool contains(std::string_view address) const;

    // The address for which a proxy connects: in its X-Forwarded-For (all such headers, joined by
    // commas) the last address that is no proxy's, since each proxy appends the one that asked it,
    // and earlier ones may be invented; the first one if all are proxies'. nullopt if there is
    // none. The result is written as Asio writes it. Safe for untrusted input.
    std::optional<std::string> client_of(std::string_view forwarded_for) const;

private:
    using Bytes16 = std::array<unsigned char, 16>;  // IPv4 as IPv6 addresses, "::ffff:10.1.2.3"
    struct Network {
        Bytes16 address;
        unsigned bits;
    };
    std::vector<Network> networks_;

    static std::optional<Bytes16> parse(std::string_view text);
    bool contains(const Bytes16& address) const;
};

}  // namespace theatron::net
