// SPDX-License-Identifier: Apache-2.0
// A folder of recorded images, loaded into memory, for benchmarks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "image/image.h"

namespace theatron::bench {

struct BenchSequence {
    std::string name;
    std::vector<DepthImage> depth;
    std::vector<ColorImage> color;  // decoded; empty if the folder has none
};

// Reads FOLDER/depth/*.png, and FOLDER/color/* if `with_color`, in order of their names, at
// most `max_frames`. Throws Error.
BenchSequence load_sequence(const std::filesystem::path& folder, bool with_color, int max_frames);

}  // namespace theatron::bench
