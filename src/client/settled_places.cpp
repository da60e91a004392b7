// SPDX-License-Identifier: Apache-2.0
#include "client/settled_places.h"

#include <algorithm>

namespace theatron::client {

const Bytes& SettledPlaces::settled(CameraId camera, const Bytes& calibration,
                                    const Bytes& adjustment, TimePoint now) {
    auto [at, is_new] = places_.try_emplace(camera, Place{calibration, calibration, {}, {}, {}});
    Place& place = at->second;
    if (adjustment.empty() && place.adjustment.empty()) {
        place = {calibration, calibration, {}, {}, {}};
        return place.recorded;
    }
    if (place.newest != calibration) {
        if (place.newest == place.recorded)
            place.since = now;
        place.newest = calibration;
        place.changed = now;
    }
    place.adjustment = adjustment;
    if (is_new || now - place.changed >= stays || now - place.since >= longest_nudging)
        place.recorded = place.newest;
    return place.recorded;
}

bool SettledPlaces::is_settling() const {
    return std::any_of(places_.begin(), places_.end(), [](const auto& entry) {
        return entry.second.newest != entry.second.recorded;
    });
}

void SettledPlaces::keep_only(const std::function<bool(CameraId)>& is_kept) {
    std::erase_if(places_, [&](const auto& entry) { return !is_kept(entry.first); });
}

}  // namespace theatron::client
