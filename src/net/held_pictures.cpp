// SPDX-License-Identifier: Apache-2.0
#include "net/held_pictures.h"

#include <algorithm>
#include <utility>

namespace theatron::net {

std::vector<std::size_t> must_go(std::span<const HeldPictures> peers) {
    std::size_t held = 0;
    std::vector<std::size_t> still;
    for (std::size_t i = 0; i < peers.size(); ++i) {
        held += peers[i].bytes;
        if (peers[i].bytes > 0 && peers[i].still >= least_still)
            still.push_back(i);
    }
    std::stable_sort(still.begin(), still.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(peers[a].records, peers[b].still) <
               std::pair(peers[b].records, peers[a].still);
    });
    std::vector<std::size_t> gone;
    for (const std::size_t i : still) {
        if (held <= max_held_bytes)
            break;
        held -= peers[i].bytes;
        gone.push_back(i);
    }
    return gone;
}

}  // namespace theatron::net
