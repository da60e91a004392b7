// SPDX-License-Identifier: Apache-2.0
// A loop that can be played from its first frames on, while the others are rendered.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

#include "base/bytes.h"
#include "image/frame.h"
#include "synthetic/loop_file.h"
#include "synthetic/loop_options.h"

namespace theatron::synthetic {

// Opens the cached file, or leaves it behind once all frames are rendered. Ended earlier, it leaves
// nothing.
class GrowingLoop {
public:
    // Returns when the first `urgent` frames are there; the other ones are rendered at a low
    // priority. Throws Error if the folder cannot be written, and what `progress` throws.
    GrowingLoop(const LoopOptions& options, std::size_t urgent, const Progress& progress = {});
    ~GrowingLoop();
    GrowingLoop(const GrowingLoop&) = delete;
    GrowingLoop& operator=(const GrowingLoop&) = delete;

    const Calibration& calibration() const { return calibration_; }
    // The number of frames, from the first on, that can be read. It only grows. Any thread.
    std::size_t frames() const;

    // Reads the images of frame `number` < frames() into `out`, whose memory is reused. One thread
    // at a time. Throws Error if the file has been damaged.
    void read(std::size_t number, Frame& out);

private:
    void render(const std::stop_token& stop, std::size_t urgent);
    void wait_for_first(std::size_t urgent, const Progress& progress);

    const LoopOptions options_;
    const Calibration calibration_;
    std::ifstream file_;  // of a draft, opened by the thread before the first frame
    Bytes buffer_;

    mutable std::mutex mutex_;  // guards the members below, but not the thread
    std::condition_variable changed_;
    std::filesystem::path path_;  // the cached file, or the draft
    std::vector<LoopEntry> index_;
    std::string_view step_;
    double step_done_ = 0;
    bool is_over_ = false;
    std::exception_ptr failure_;

    std::jthread thread_;  // the last member: it ends first
};

}  // namespace theatron::synthetic
