// SPDX-License-Identifier: Apache-2.0
#include "host/port_places.h"

#include <algorithm>

namespace theatron::host {

std::size_t PortPlaces::still_kept(SessionNumber session, Kind kind) const {
    const auto found = taken_.find(session);
    if (found == taken_.end())
        return 0;
    const std::size_t kept = kept_for[std::size_t(kind)];
    return kept - std::min(kept, found->second[std::size_t(kind)]);
}

bool PortPlaces::has_place(SessionNumber session, Kind kind) const {
    if (places_.size() >= most)
        return false;
    const std::size_t own = still_kept(session, kind);
    std::size_t kept = 0;
    for (const auto& [each, taken] : taken_)
        for (std::size_t k = 0; k < kinds; ++k)
            kept += still_kept(each, Kind(k));
    return own > 0 || most - places_.size() > kept;
}

void PortPlaces::enter(net::PeerId peer, SessionNumber session, Kind kind) {
    leave(peer);
    places_[peer] = {session, kind};
    ++taken_[session][std::size_t(kind)];
}

void PortPlaces::leave(net::PeerId peer) {
    const auto place = places_.extract(peer);
    if (!place)
        return;
    if (const auto taken = taken_.find(place.mapped().session); taken != taken_.end())
        --taken->second[std::size_t(place.mapped().kind)];
}

}  // namespace theatron::host
