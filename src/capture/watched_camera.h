// SPDX-License-Identifier: Apache-2.0
// Supervises a camera with CameraCare: discards bad pictures, reports when the camera is
// stale, and opens a live one again.
//
// One thread at a time calls step(). If it hangs in a driver, abandon() transfers the camera,
// opened again, to another thread.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "capture/camera.h"
#include "capture/camera_care.h"
#include "capture/clock.h"
#include "wire/control.h"

namespace theatron::capture {

class WatchedCamera {
public:
    // Opens the same camera again. May throw Error. Empty: the camera cannot be opened again.
    using Open = std::function<std::unique_ptr<Camera>()>;

    // `patient`: the camera skips none of its pictures, so each is taken, however late, and its
    // file may take any time.
    WatchedCamera(std::unique_ptr<Camera> camera, Open open_again, Clock clock = steady_clock(),
                  bool patient = false);

    const CameraInfo& info() const { return info_; }

    // Identifies the thread that may use the camera.
    enum class Turn : unsigned {};
    Turn turn() const;

    struct Step {
        FramePtr frame;     // a good frame; null if none came within the timeout
        bool over = false;  // ended, failed for good, or abandoned for another thread
    };
    Step step(Turn turn, Duration timeout);

    // A call that takes longer hangs; opening a camera may take seconds.
    static constexpr Duration longest_call = 3s, longest_opening = 30s;

    // From any thread: abandons the thread in step(), and returns the next turn.
    Turn abandon();

    // From any thread: the process was suspended, perhaps with its machine, so the time until
    // now does not count as a hanging driver.
    void forgive();

    // From any thread: the current status.
    struct Status {
        wire::CameraCondition condition{};
        Trouble trouble = Trouble::none;
        wire::Text problem;  // if the camera is not live
        CameraCare::Figures figures;
        Duration without_picture{};  // since the last good one
        bool hangs = false;          // step() does not return from the camera's code
        // Camera::lost_pictures(), as of the last second; `problem` names it where nothing else is
        // wrong.
        std::uint64_t lost_pictures = 0;
    };
    Status status() const;

private:
    Step reopen(Turn turn);
    Step take(Turn turn, Camera& camera, Duration timeout);
    void note_lost(std::uint64_t pictures, bool at_once);
    Step end(wire::CameraCondition how, std::string problem);

    const CameraInfo info_;
    const Open open_again_;
    const Clock clock_;
    const bool patient_;

    mutable std::mutex mutex_;  // guards all members below
    std::shared_ptr<Camera> camera_;
    mutable CameraCare care_;
    unsigned turn_ = 0;
    TimePoint entered_driver_;  // zero: no thread is in the driver
    bool opening_ = false;      // that thread is opening the camera
    bool over_ = false;
    bool rests_ = false;  // at the end of a recording that may go on
    wire::CameraCondition how_over_{};
    std::string problem_;
    std::uint64_t lost_pictures_ = 0;
    TimePoint lost_noted_;
};

// The mark of a picture, for the comparison with the next.
PictureMark mark_of(DepthView depth);

}  // namespace theatron::capture
