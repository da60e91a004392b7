// SPDX-License-Identifier: Apache-2.0
// Renders all frames of a loop with two threads.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <string_view>

#include "synthetic/frame_maker.h"
#include "synthetic/loop_options.h"

namespace theatron::synthetic {

class RoomView;

// Used once. `options` must outlive this object.
class LoopRenderer {
public:
    // Takes the frames in order, on the thread that called render(). May throw.
    using Take = std::function<void(const EncodedFrame& frame)>;

    // Behind frame `urgent` the threads leave the processors to others.
    LoopRenderer(const LoopOptions& options, Take take, Progress progress,
                 std::size_t urgent = std::numeric_limits<std::size_t>::max())
        : options_(options),
          frames_(frames_of(options)),
          urgent_(urgent),
          take_(std::move(take)),
          progress_(std::move(progress)) {}

    // Throws what `take` or `progress` threw. `progress` is called some fifty times a second, also
    // while one frame is rendered.
    void render();

private:
    void tell(std::string_view what, double done);
    // Tells again what was told last, now and then; on the caller's thread. The other thread ends
    // with the first one.
    void pulse(bool is_callers);
    void work(const OperatingRoom& room, RoomView& view, bool takes);
    void take_ready();

    const LoopOptions& options_;
    const std::size_t frames_, urgent_;
    const Take take_;
    const Progress progress_;
    std::atomic<std::size_t> next_ = 0;
    std::atomic<bool> failed_ = false;
    std::mutex mutex_;  // guards the members below
    std::map<std::size_t, EncodedFrame> ready_;
    std::exception_ptr failure_;
    // Used by the caller's thread only.
    std::size_t taken_ = 0;
    std::string_view told_;
    double told_done_ = 0;
    TimePoint next_pulse_;
};

}  // namespace theatron::synthetic
