// SPDX-License-Identifier: Apache-2.0
// How well the lattice board is found and cameras are registered, against exact truth through the
// modelled sensor.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "capture/camera.h"

namespace theatron::bench {

struct RegistrationBenchOptions {
    int images = 300;  // for detection; a quarter of them without a board
    int seeds = 20;    // of cameras and places of the board
    int frames = 30;   // averaged for each view
    int threads = 1;   // seeds at once; the results do not depend on it
};

// For a look at whether all works; the errors of so few seeds say little.
inline constexpr RegistrationBenchOptions quick_registration_bench{40, 2, 5, 1};

// Keys as in docs/registration.md. Times are of the processor, for one thread.
nlohmann::json bench_registration(const RegistrationBenchOptions& options,
                                  const capture::Progress& progress);

}  // namespace theatron::bench
