// SPDX-License-Identifier: Apache-2.0
// Chooses the peers that must go because pictures that wait for them take too much memory. Each
// peer that reads nothing holds the picture of which a part has left, and nobody else needs that
// one any more: with large pictures, many such peers would take the memory of all. Pure.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/time.h"

namespace theatron::net {

// Pictures that wait for all peers of a port together take at most this.
inline constexpr std::size_t max_held_bytes = std::size_t(256) << 20;
// A peer that took something more lately stays.
inline constexpr Duration least_still = std::chrono::seconds(2);

// The pictures that wait for a peer.
struct HeldPictures {
    std::size_t bytes = 0;  // its share of those that several peers hold
    Duration still{};       // since it took something
    bool records = false;   // everything is kept for it: it goes after the others
};

// The indices of the peers that must go, until the others hold at most max_held_bytes.
std::vector<std::size_t> must_go(std::span<const HeldPictures> peers);

}  // namespace theatron::net
