// SPDX-License-Identifier: Apache-2.0
// theatron photon check
#pragma once

namespace theatron::app {

struct PhotonCheck {
    int films = 6;  // for each rate
    bool json = false;
};

// Measures films with known delays, drawn by this program, and prints how wrong the results are.
void run_photon_check(const PhotonCheck& wanted);

}  // namespace theatron::app
