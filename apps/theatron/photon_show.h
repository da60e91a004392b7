// SPDX-License-Identifier: Apache-2.0
// theatron photon show
#pragma once

#include "image/view.h"

namespace theatron::app {

struct PhotonShow {
    Size size{1280, 560};
    bool full_screen = false;
    double seconds = 0;  // 0: until it is closed
};

// Shows the strip with this computer's time in a window. Throws Error where none can be opened.
void run_photon_show(const PhotonShow& wanted);

}  // namespace theatron::app
