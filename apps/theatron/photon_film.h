// SPDX-License-Identifier: Apache-2.0
// theatron photon film
#pragma once

#include <string>

namespace theatron::app {

struct PhotonFilm {
    std::string film, plot;  // an empty plot is none
    double refresh_hz = 60;
    bool json = false, overwrite = false;
};

// Measures the latency that a film shows, and prints it. Throws Error with one sentence if the film
// cannot be read or shows none.
void run_photon_film(const PhotonFilm& wanted);

}  // namespace theatron::app
