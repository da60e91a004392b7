// SPDX-License-Identifier: Apache-2.0
#include "send/capture_thread.h"

#include <utility>

#include "base/fault.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "base/thread_name.h"

namespace theatron::send {
namespace {

constexpr Duration patience = 100ms;       // for one picture
constexpr Duration last_patience = 500ms;  // for a thread to end
// Between two calls of look(). After a longer pause the process was stopped, not a driver.
constexpr Duration longest_pause = 1s;

}  // namespace

CaptureThread::CaptureThread(std::unique_ptr<capture::Camera> camera,
                             capture::WatchedCamera::Open open_again,
                             std::function<void(FramePtr)> sink, capture::Clock clock, bool patient)
    : now_(clock.now),
      looked_(now_()),
      shared_(new Shared{capture::WatchedCamera(std::move(camera), std::move(open_again),
                                                std::move(clock), patient),
                         {},
                         std::move(sink)}) {
    start(shared_->camera.turn());
}

CaptureThread::~CaptureThread() {
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->sink = nullptr;
    }
    shared_->camera.abandon();
    const TimePoint deadline = steady_now() + last_patience;
    for (Runner& runner : runners_) {
        while (!*runner.done && steady_now() < deadline)
            std::this_thread::sleep_for(1ms);
        if (*runner.done)
            runner.thread.join();
        else
            runner.thread.detach();
    }
}

void CaptureThread::start(capture::WatchedCamera::Turn turn) {
    Runner runner;
    runner.thread = std::thread([shared = shared_, turn, done = runner.done] {
        name_this_thread("capture");
        run(*shared, turn);
        *done = true;
    });
    runners_.push_back(std::move(runner));
}

void CaptureThread::run(Shared& shared, capture::WatchedCamera::Turn turn) {
    bool over = false;
    while (!over) {
        const bool fine = contain("capture", [&] {
            capture::WatchedCamera::Step step = shared.camera.step(turn, patience);
            over = step.over;
            if (step.frame) {
                const std::lock_guard lock(shared.mutex);
                if (shared.sink)
                    shared.sink(std::move(step.frame));
            }
        });
        // A camera that throws repeatedly gives no frames, so its status becomes stale.
        if (!fine)
            std::this_thread::sleep_for(patience);
    }
}

capture::WatchedCamera::Status CaptureThread::look() {
    const TimePoint now = now_();
    if (now - std::exchange(looked_, now) > longest_pause)
        shared_->camera.forgive();
    const capture::WatchedCamera::Status status = shared_->camera.status();
    if (!status.hangs)
        return status;
    std::erase_if(runners_, [](Runner& runner) {
        if (!*runner.done)
            return false;
        runner.thread.join();
        return true;
    });
    if (runners_.size() > most_left_behind)
        return status;
    log::warning("send", "the camera's driver hangs, the camera is opened again",
                 {{"camera", info().name}});
    start(shared_->camera.abandon());
    return shared_->camera.status();
}

}  // namespace theatron::send
