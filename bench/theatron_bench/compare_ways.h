// SPDX-License-Identifier: Apache-2.0
// The table of all methods of `theatron bench compare`: their words, their cameras, and what
// happens to the pictures of these.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compare_paths.h"

namespace theatron::bench {

struct CompareWay {
    enum class Shown { video, zoomed_video, clouds, points, pair };

    CompareMethod words;  // without figures; `reason` if it cannot be measured here
    std::vector<const CompareCamera*> cameras;
    std::function<std::unique_ptr<CameraPath>(const CompareCamera&)> path;
    bool arrives_as_taken = false;  // the colour pictures: they have the cameras' own pixels
    Shown shown = Shown::clouds;
    const CompareViews* views = nullptr;  // exact pictures
    std::string renderer;                 // clouds
    std::size_t kept = 1;                 // how many of the last images its drawing gets
    // pair: the ids of two ways before it in the table. It has the cameras of both, which work at
    // once.
    std::vector<std::string> parts;
};

// `scene` lives longer than the table.
std::vector<CompareWay> compare_ways(const CompareScene& scene);

}  // namespace theatron::bench
