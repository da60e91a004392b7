// SPDX-License-Identifier: Apache-2.0
// How well the lattice board is found and cameras are registered, against exact truth through the
// modelled sensor.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "capture/camera.h"

namespace theatron::bench {

struct RegistrationBenchOptions {
    int images = 200;  // for detection; a quarter of them without a board
    int seeds = 20;    // of cameras and places of the board
    int frames = 30;   // averaged for each view
};

// Keys as in docs/registration.md. Uses one thread; times are of its processor time.
nlohmann::json bench_registration(const RegistrationBenchOptions& options,
                                  const capture::Progress& progress);

}  // namespace theatron::bench
