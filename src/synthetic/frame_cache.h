// SPDX-License-Identifier: Apache-2.0
// The loop of one synthetic camera: rendered once and stored in a file, so that playback
// only reads it.
//
// The file's key covers everything that changes the pictures. The file is written
// atomically, checked when it is opened, and rendered again if it is damaged.
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
    // Depth at a fraction of the full size, for tests and demonstrations: 1, 2, 4 or 8.
    int depth_divisor = 1;
    double frames_per_second = 30;
    bool noise = true;             // false: exact depth in millimetres, without sensor model
    std::filesystem::path folder;  // of the cache; empty: default_cache_folder()
};

// $XDG_CACHE_HOME/theatron, or .cache/theatron in the home folder.
std::filesystem::path default_cache_folder();

// Reports the progress of long preparations: the current activity, and its share done (0 to 1).
using Progress = std::function<void(std::string_view what, double done)>;

// The camera's calibration, without rendering anything.
Calibration loop_calibration(const LoopOptions& options);

// The file of this loop. It may not exist yet.
std::filesystem::path loop_path(const LoopOptions& options);

// An opened loop. One thread at a time.
class FrameLoop {
public:
    // Opens the cached loop. If there is none, renders it first, with two threads. Throws
    // Error if the folder cannot be written.
    explicit FrameLoop(const LoopOptions& options, const Progress& progress = {});

    const Calibration& calibration() const { return calibration_; }
    std::size_t frames() const { return index_.size(); }
    bool was_cached() const { return was_cached_; }
    const std::filesystem::path& path() const { return path_; }

    // Reads the images of frame `number` < frames() into `out`, whose memory is reused.
    // Throws Error if the file has been damaged since it was opened.
    void read(std::size_t number, Frame& out);

private:
    struct Entry {
        std::uint64_t at = 0;  // file offset of the depth bytes, which the colour bytes follow
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
