// SPDX-License-Identifier: Apache-2.0
// The choices that make the pictures of one synthetic camera, and the file that keeps them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "synthetic/operating_room.h"

namespace theatron::synthetic {

struct LoopOptions {
    SceneOptions scene;
    Variant variant = Variant::room;
    int camera = 0, cameras = 2;
    Size color{1280, 720};  // 0 x 0: no colour
    // Depth at a fraction of the full size, for tests and demonstrations: 1, 2, 4 or 8.
    int depth_divisor = 1;
    double frames_per_second = 30;
    bool noise = true;             // false: exact depth in millimetres, without sensor model
    std::filesystem::path folder;  // of the cache; empty: default_cache_folder()
};

// Reports the progress of long preparations: the current activity, and its share done (0 to 1).
using Progress = std::function<void(std::string_view what, double done)>;

// $XDG_CACHE_HOME/theatron, or .cache/theatron in the home folder.
std::filesystem::path default_cache_folder();

// At least 1.
std::size_t frames_of(const LoopOptions& options);

// The camera's calibration, without rendering anything.
Calibration loop_calibration(const LoopOptions& options);

// Covers everything that changes the pictures.
std::string key_of(const LoopOptions& options);

// The file of this loop. It may not exist yet.
std::filesystem::path loop_path(const LoopOptions& options);

}  // namespace theatron::synthetic
