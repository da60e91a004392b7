// SPDX-License-Identifier: Apache-2.0
// A camera under care: passes over what is not a good picture, knows when it is
// stale, and opens a live one again by itself.
//
// One thread at a time takes pictures with step(). Should that thread never come
// back out of a driver, abandon() lets another one take its turn with the camera
// opened anew.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "capture/camera.h"
#include "capture/camera_care.h"
#include "wire/control.h"

namespace theatron::capture {

class WatchedCamera {
public:
    // Opens the same camera again. May throw Error. Empty: it cannot be had again.
    using Open = std::function<std::unique_ptr<Camera>()>;

    struct Clock {
        std::function<TimePoint()> now;
        std::function<void(Duration)> sleep;
    };
    static Clock steady_clock();

    WatchedCamera(std::unique_ptr<Camera> camera, Open open_again, Clock clock = steady_clock());

    const CameraInfo& info() const { return info_; }

    // Which thread's turn it is.
    enum class Turn : unsigned {};
    Turn turn() const;

    struct Step {
        FramePtr frame;     // a good one, or none came within the time given
        bool over = false;  // ended, failed for good, or it is another thread's turn
    };
    Step step(Turn turn, Duration timeout);

    // A driver that takes longer than this hangs; opening a camera may take seconds.
    static constexpr Duration longest_call = 3s, longest_opening = 30s;

    // From any thread: gives up on whoever is in step(), and returns the next turn.
    Turn abandon();

    // From any thread: this process stood still, its machine perhaps asleep, so the time until now
    // says nothing about the driver.
    void forgive();

    // From any thread, as of now.
    struct Status {
        wire::CameraCondition condition{};
        Trouble trouble = Trouble::none;
        std::string problem;  // one sentence where it is not live
        CameraCare::Figures figures;
        Duration without_picture{};  // since the last good one
        bool hangs = false;          // step() does not come back out of the camera's code
    };
    Status status() const;

private:
    Step reopen(Turn turn);
    Step take(Turn turn, Camera& camera, Duration timeout);
    Step end(wire::CameraCondition how, std::string problem);

    const CameraInfo info_;
    const Open open_again_;
    const Clock clock_;

    mutable std::mutex mutex_;  // guards all below
    std::shared_ptr<Camera> camera_;
    mutable CameraCare care_;
    unsigned turn_ = 0;
    TimePoint entered_driver_;  // zero: nobody is in there
    bool opening_ = false;      // in there
    bool over_ = false;
    wire::CameraCondition how_over_{};
    std::string problem_;
};

// A value that differs between pictures that differ anywhere much.
PictureMark mark_of(DepthView depth);

}  // namespace theatron::capture
