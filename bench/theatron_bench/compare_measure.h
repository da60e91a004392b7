// SPDX-License-Identifier: Apache-2.0
// Measures every method of `theatron bench compare`.
#pragma once

#include "capture/camera.h"
#include "compare.h"
#include "compare_scene.h"

namespace theatron::bench {

struct CompareOptions {
    CompareSceneOptions scene;
    std::vector<CompareLink> links = {{20, 20}, {100, 20}};
};

// Throws Error where the machine cannot make the input. A method that this machine lacks has its
// reason instead of figures.
Compared measure_compare(const CompareOptions& options, const capture::Progress& progress);

}  // namespace theatron::bench
