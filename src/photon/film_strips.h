// SPDX-License-Identifier: Apache-2.0
// The strips of a film, frame by frame: which of a frame's strips is which of the frame before.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "photon/strip_reader.h"

namespace theatron::photon {

// A frame of a film that shows two strips. Nullopt where one is hidden or cannot be read.
struct FilmFrame {
    double film_ms = 0;  // by the film's own clock
    std::array<std::optional<StripTime>, 2> times;
};

class FilmStrips {
public:
    // `film_ms` grows from frame to frame. `size`: of the picture.
    void add(double film_ms, Size size, std::span<const StripReading> strips);

    int frames() const { return int(frame_ms_.size()); }

    struct Place {
        int seen = 0, read = 0;           // frames
        double x_share = 0, y_share = 0;  // the mean middle, as shares of the picture's sides
        double contrast = 0;              // the mean, 0 to 255
    };
    struct Pair {
        std::string
            problem;  // one sentence, if the film has not two strips; the rest is empty then
        std::vector<FilmFrame> frames;
        std::array<Place, 2> places;
    };
    // The two strips that the film shows. A strip in fewer than a tenth of the frames is none.
    Pair pair() const;

private:
    struct Track {
        Quad last;
        Place sums;
        std::vector<std::optional<StripTime>> times;  // of the film's first frames
    };
    Track* nearest(const Quad& frame);

    std::vector<double> frame_ms_;
    std::vector<Track> tracks_;
};

}  // namespace theatron::photon
