// SPDX-License-Identifier: Apache-2.0
// The thread that waits for one camera. If the camera's driver does not return,
// another thread takes its place.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "capture/watched_camera.h"

namespace theatron::send {

class CaptureThread {
public:
    // `sink` is called from the thread, and never after the destructor has returned.
    // `patient`: as in WatchedCamera.
    CaptureThread(std::unique_ptr<capture::Camera> camera, capture::WatchedCamera::Open open_again,
                  std::function<void(FramePtr)> sink, capture::Clock clock, bool patient = false);
    ~CaptureThread();

    const capture::CameraInfo& info() const { return shared_->camera.info(); }

    // The camera's status. Call it every 20 ms, from one thread: this call also
    // replaces a thread whose driver hangs.
    capture::WatchedCamera::Status look();

private:
    // Outlives the lane if a driver never comes back.
    struct Shared {
        capture::WatchedCamera camera;
        std::mutex mutex;  // held while the sink works
        std::function<void(FramePtr)> sink;
    };
    struct Runner {
        std::thread thread;
        std::shared_ptr<std::atomic<bool>> done = std::make_shared<std::atomic<bool>>(false);
    };
    // Threads of one camera that may hang in its driver; more are not started.
    static constexpr std::size_t most_left_behind = 3;

    void start(capture::WatchedCamera::Turn turn);
    static void run(Shared& shared, capture::WatchedCamera::Turn turn);

    const std::function<TimePoint()> now_;
    TimePoint looked_;  // the last time
    std::shared_ptr<Shared> shared_;
    std::vector<Runner> runners_;  // the last one is at work
};

}  // namespace theatron::send
