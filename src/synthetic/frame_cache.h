// SPDX-License-Identifier: Apache-2.0
// The loop of one synthetic camera, rendered once and kept in a file, so that
// playing it costs no more than reading.
//
// The file is keyed by everything that changes the pictures, written whole or
// not at all, checked when it is opened and rendered again where it is damaged.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>

#include "base/bytes.h"
#include "image/frame.h"
#include "synthetic/operating_room.h"

namespace theatron::synthetic {

struct LoopOptions {
    SceneOptions scene;
    Variant variant = Variant::room;
    int camera = 0, cameras = 2;
    Size color{1280, 720};  // 0 x 0: no colour
    // Depth at this share of full size, for tests and demonstrations: 1, 2, 4 or 8.
    int depth_divisor = 1;
    double frames_per_second = 30;
    bool noise = true;             // as the sensor would measure; otherwise exact, in millimetres
    std::filesystem::path folder;  // of the cache; empty: default_cache_folder()
};

// $XDG_CACHE_HOME/theatron, or .cache/theatron in the home folder.
std::filesystem::path default_cache_folder();

// Told about long preparations: what is being done, and how far (0 to 1).
using Progress = std::function<void(std::string_view what, double done)>;

// The camera's calibration, without rendering anything.
Calibration loop_calibration(const LoopOptions& options);

// The file that holds this loop, there or not.
std::filesystem::path loop_path(const LoopOptions& options);

// An opened loop. Used by one thread at a time.
class FrameLoop {
public:
    // Opens the cached loop, or renders it first, with two threads. Throws Error
    // where the folder cannot be written.
    explicit FrameLoop(const LoopOptions& options, const Progress& progress = {});

    const Calibration& calibration() const { return calibration_; }
    std::size_t frames() const { return index_.size(); }
    bool was_cached() const { return was_cached_; }
    const std::filesystem::path& path() const { return path_; }

    // Reads the images of frame `number` < frames() into `out`, whose old content
    // is stale. Throws Error if the file has been damaged since it was opened.
    void read(std::size_t number, Frame& out);

private:
    struct Entry {
        std::uint64_t at = 0;  // of the depth bytes; the colour's follow
        std::uint32_t depth_bytes = 0, color_bytes = 0;
    };
    bool open(const std::string& key);

    Calibration calibration_;
    std::filesystem::path path_;
    std::ifstream file_;
    std::vector<Entry> index_;
    Bytes buffer_;
    bool was_cached_ = false;
};

}  // namespace theatron::synthetic
