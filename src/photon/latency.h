// SPDX-License-Identifier: Apache-2.0
// From the times that two strips show in a film to the latency between them.
//
// No clock is trusted: the strip of the scene's screen is the clock. It tells how fast the film's
// own time runs (slow motion is found that way) and, by when its times begin to be seen, what time
// it is in the middle of each frame, finer than the screen's refresh. For each time that the
// display begins to show, the latency is from when the scene's screen began to show it. The film's
// frames tell both only as intervals; the middles are taken, and the interval of the mean holds
// what is not known.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "photon/film_strips.h"

namespace theatron::photon {

struct Spread {
    double mean = 0, median = 0, p5 = 0, p95 = 0, least = 0, most = 0;
};
// All zero without values.
Spread spread_of(std::vector<double> values);

// A time that the display began to show.
struct SeenChange {
    double at_ms = 0;       // by the strip's clock, since the film's first frame
    double latency_ms = 0;  // since the scene's screen began to show it
};

struct FilmLatency {
    std::string problem;  // the end of a sentence that begins with "The film cannot be used:"; the
                          // rest is empty then
    std::size_t scene = 0;         // which of the two strips is ahead
    double speed = 1;              // of the film's time, in strip time: 0.125 in a slow motion of 8
    double frames_per_second = 0;  // by the strip's clock
    int frames = 0, scene_read = 0, display_read = 0;
    int left_out = 0;  // readings that contradict all others

    std::vector<SeenChange> changes;
    Spread latency_ms;              // motion to photon: of the changes
    double from_ms = 0, to_ms = 0;  // the mean is in here with a probability of 95 %
    Spread age_ms;  // of what the display shows, over all frames: grows until the next change
};

// `refresh_hz`: of the scene's screen, if the film has fewer frames a second than that; a faster
// film shows it. Frames are in the order of their times.
FilmLatency latency_of(std::span<const FilmFrame> frames, double refresh_hz);

}  // namespace theatron::photon
