// SPDX-License-Identifier: Apache-2.0
// The clock that a filmed strip is: what time it is in each frame of the film.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "photon/strip.h"

namespace theatron::photon {

// A strip that was read in a film.
struct Sighting {
    double film_ms = 0;
    StripTime time = 0;
};

struct SceneClock {
    std::string problem;  // the end of a sentence, if these sightings are no clock
    StripTime zero = 0;
    double film_zero_ms = 0, speed = 1;
    double offset_ms = 0;  // the middle of where it can be
    double least_offset_ms = 0, most_offset_ms = 0;
    int left_out = 0;  // sightings that contradict the others

    // Milliseconds since the strip showed `zero`.
    double at(double film_ms) const { return offset_ms + speed * (film_ms - film_zero_ms); }
    // `time` on the same scale, as the one nearest to `near_ms`.
    double unwrapped(StripTime time, double near_ms) const;
};

// The sightings are in the order of their film times. `refresh_hz`: of the screen, as in
// latency_of().
SceneClock scene_clock_of(std::span<const Sighting> sightings, double refresh_hz);

}  // namespace theatron::photon
