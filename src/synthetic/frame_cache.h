// SPDX-License-Identifier: Apache-2.0
// The loop of one synthetic camera: rendered once and stored in a file, so that playback
// only reads it. The file is written atomically, checked when it is opened, and rendered again if
// it is damaged.
#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "base/bytes.h"
#include "image/frame.h"
#include "synthetic/loop_file.h"
#include "synthetic/loop_options.h"

namespace theatron::synthetic {

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
    bool open(const std::string& key);

    Calibration calibration_;
    std::filesystem::path path_;
    std::ifstream file_;
    std::vector<LoopEntry> index_;
    Bytes buffer_;
    bool was_cached_ = false;
};

}  // namespace theatron::synthetic
