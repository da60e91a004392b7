// SPDX-License-Identifier: Apache-2.0
// Limits connections that have not shown a token: chooses those that are kept and the next TLS
// handshake, so that strangers cannot shut out people who have the token
// (docs/decisions/strangers.md).
//
// A connection is pending from its acceptance until its token was seen. Addresses from which a
// token came before are known, and have places of their own. Pure: no sockets, time is an
// argument. Not thread safe.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <optional>
#include <string>

#include "base/time.h"

namespace theatron::net {

class Places {
public:
    // Pending connections of strangers, and as many of known addresses.
    static constexpr std::size_t max_pending = 256;
    // Known addresses; the one that was noted longest ago is forgotten first.
    static constexpr std::size_t max_known = 256;
    // TLS handshakes begun: each costs about 0.7 ms of a core. Strangers all together, known
    // addresses all together, and a single address.
    static constexpr double handshakes_per_second = 200, handshakes_per_second_and_address = 100;

    // Handshakes that a wrong token costs its address, half a second's, and the largest debt of an
    // address, so that a participant behind the same address gets in before its deadline.
    static constexpr double wrong_token_cost = 50, max_wrong_token_debt = 150;

    enum class Id : std::uint64_t {};

    // A connection from `address` was accepted. Returns its id, and the connection to close for
    // it, if any: the longest pending one of the address that has the most.
    struct Entered {
        Id id{};
        std::optional<Id> evicted;
    };
    Entered enter(const std::string& address);
    void leave(Id id);

    // The same for a connection of a trusted proxy, which brings those of many people: it has a
    // place as a known address has, and its handshakes are not counted against its address.
    Entered enter_of_proxy(const std::string& address);
    // A connection of a proxy turned out to be one from `address` and counts as such from now on.
    // Returns the connection to close for it, if any. Its answer waits as a handshake does: see
    // want_handshake().
    std::optional<Id> act_for(Id id, const std::string& address);

    // The connection that would be evicted next.
    std::optional<Id> next_to_go() const;

    // The token was shown from this address.
    void note_known(const std::string& address);
    bool is_known(const std::string& address) const { return known_.contains(address); }

    // A wrong token was shown from this address. A known address has no debt: participants may be
    // behind it, and guesses from there are still limited by handshakes_per_second_and_address.
    void note_wrong_token(const std::string& address, TimePoint now);

    // `id` waits for its handshake, or for the answer to a request that a proxy forwarded.
    void want_handshake(Id id);
    // The connection whose handshake may begin now: known addresses first, then the address with
    // the fewest recent handshakes, and of its connections the one that waits longest.
    std::optional<Id> next_handshake(TimePoint now);
    bool handshakes_wait() const { return waiting_ > 0; }

    std::size_t pending() const { return entries_.size(); }

private:
    // A rate limit whose burst is a tenth of a second's handshakes.
    struct Budget {
        double left = 0;
        TimePoint filled;
        void fill(double per_second, TimePoint now);
    };
    struct Entry {
        std::string address;
        bool known = false;
        bool waits = false;
        bool is_of_proxy = false;
    };
    Entered take(Entry entry);
    // Makes a place among known addresses or strangers. Returns the connection that lost its own.
    std::optional<Id> make_room(bool known);

    std::map<Id, Entry> entries_;  // oldest first
    std::uint64_t next_id_ = 1;
    std::size_t waiting_ = 0;
    std::map<std::string, std::uint64_t> known_;  // when heard of last, as a count
    std::uint64_t heard_ = 0;
    Budget strangers_, regulars_, proxies_;
    std::map<std::string, Budget> by_address_;

    std::optional<Id> longest_of_the_largest(bool known) const;
    void refill(TimePoint now);
};

// The key under which limits count an address: an IPv4 address itself, or the 64-bit prefix of an
// IPv6 address, which one network has. `text` as Asio writes addresses.
std::string address_group(const std::string& text);

}  // namespace theatron::net
