// SPDX-License-Identifier: Apache-2.0
// The places of a port for connections that have shown a token, shared among its sessions, so that
// nobody who has links of one session alone shuts out others. Pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "net/server.h"

namespace theatron::host {

// A session of a port. Numbers begin with 1 and are not used again.
enum class SessionNumber : std::uint32_t {};

class PortPlaces {
public:
    static constexpr std::size_t most = net::Server::max_invited;
    enum class Kind : std::uint8_t {
        operator_,
        recorder_again,  // that comes back
        viewer_again,    // somebody else who comes back
        other,
    };
    static constexpr std::size_t kinds = 4;
    // Places that others leave free for each kind of each session; further ones go to whoever comes
    // first.
    static constexpr std::array<std::size_t, kinds> kept_for{4, 4, 2, 2};

    void add(SessionNumber session) { taken_[session]; }
    void remove(SessionNumber session) { taken_.erase(session); }

    // True if a connection of this kind may come in.
    bool has_place(SessionNumber session, Kind kind) const;
    void enter(net::PeerId peer, SessionNumber session, Kind kind);
    void leave(net::PeerId peer);

private:
    struct Place {
        SessionNumber session{};
        Kind kind{};
    };
    std::size_t still_kept(SessionNumber session, Kind kind) const;

    std::map<SessionNumber, std::array<std::size_t, kinds>> taken_;
    std::map<net::PeerId, Place> places_;
};

}  // namespace theatron::host
