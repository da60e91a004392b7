// SPDX-License-Identifier: Apache-2.0
// theatron photon read
#pragma once

#include <string>
#include <vector>

#include "join_flags.h"

namespace theatron::app {

struct PhotonRead {
    std::vector<std::string> sources;  // a link, a camera, or PNG files
    std::string view = "camera:0", size = "1280x720", renderer = "auto";
    std::string depth_codec = "strata", color_codec = best_color();
    std::string save;  // the last picture, as a PNG file; empty: none
    std::string plot;  // the stages of the age, as an SVG file; empty: none
    double seconds = 10;
    bool json = false;
};

// Reads the strip in pictures and prints its age, or in files its time. Throws Error with one
// sentence if there are no pictures or no strip.
void run_photon_read(const PhotonRead& wanted);

}  // namespace theatron::app
