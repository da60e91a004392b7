// SPDX-License-Identifier: Apache-2.0
// Reads a strip whose place in a picture is roughly known.
#pragma once

#include <optional>

#include "photon/grey.h"
#include "photon/strip.h"

namespace theatron::photon {

// Moves the corners of a strip's black frame to where its edges are seen, to fractions of a pixel.
// They may be off by about a cell. Nullopt where a side is no edge from dark (inside) to bright.
std::optional<Quad> refined(GreyView grey, const Quad& frame);

struct StripReading {
    Quad frame;  // the first corner is the strip's left upper one
    // If the screen changed while the picture was taken, the time that was seen for longer.
    // Nullopt: it is a strip, by its fixed cells, but its time cannot be read: it is too blurred,
    // or a mixture of more than two times.
    std::optional<StripTime> time;
    double contrast = 0;  // the least distance of black and white, 0 to 255
};

// Reads the strip whose frame has these corners. Nullopt: no strip is there in this direction.
std::optional<StripReading> read_strip(GreyView grey, const Quad& frame);

}  // namespace theatron::photon
