// SPDX-License-Identifier: Apache-2.0
#include "synthetic/loop_renderer.h"

#include <sys/resource.h>
#include <unistd.h>

#include <thread>
#include <utility>

#include "base/error.h"
#include "base/steady_clock.h"
#include "base/thread_name.h"

namespace theatron::synthetic {
namespace {

constexpr int niceness_when_not_urgent = 15;
constexpr Duration pulse_interval = std::chrono::milliseconds(20);

}  // namespace

void LoopRenderer::render() {
    tell("building the synthetic operating room", 0);
    const OperatingRoom room(options_.scene, [this] { pulse(true); });
    tell("drawing what does not move", 0.02);
    RenderOptions wanted;
    wanted.surface = options_.noise;
    wanted.color = options_.color.area() > 0;
    const auto view = room.look_from(loop_calibration(options_), wanted, [this] { pulse(true); });
    const auto twin = view->share();
    std::thread second([&] {
        name_this_thread("room renderer");
        work(room, *twin, false);
    });
    work(room, *view, true);
    second.join();
    if (!failure_)
        take_ready();
    if (failure_)
        std::rethrow_exception(failure_);
    // Progress of the last frames may come from the second thread, which does not report.
    tell("rendering the synthetic operating room", 1);
}

void LoopRenderer::tell(std::string_view what, double done) {
    told_ = what;
    told_done_ = done;
    next_pulse_ = steady_now() + pulse_interval;
    if (progress_)
        progress_(what, done);
}

void LoopRenderer::pulse(bool is_callers) {
    if (failed_)
        throw Error("The other thread has failed.");
    if (is_callers && steady_now() >= next_pulse_)
        tell(told_, told_done_);
}

void LoopRenderer::work(const OperatingRoom& room, RoomView& view, bool takes) {
    try {
        FrameMaker maker(options_);
        while (!failed_) {
            const std::size_t i = next_++;
            if (i >= frames_)
                break;
            if (i >= urgent_)
                setpriority(PRIO_PROCESS, id_t(gettid()), niceness_when_not_urgent);
            const auto time =
                Duration(options_.scene.loop.count() * std::int64_t(i) / std::int64_t(frames_));
            EncodedFrame frame = maker.encode(
                view.render(*room.at(time), [this, takes] { pulse(takes); }), std::uint32_t(i));
            {
                const std::lock_guard lock(mutex_);
                ready_.emplace(i, std::move(frame));
            }
            if (takes) {
                take_ready();
                tell("rendering the synthetic operating room",
                     0.05 + 0.95 * double(taken_) / double(frames_));
            }
        }
    } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure_)
            failure_ = std::current_exception();
        failed_ = true;
    }
}

void LoopRenderer::take_ready() {
    for (;;) {
        EncodedFrame frame;
        {
            const std::lock_guard lock(mutex_);
            const auto at = ready_.find(taken_);
            if (at == ready_.end())
                return;
            frame = std::move(at->second);
            ready_.erase(at);
        }
        take_(frame);
        ++taken_;
    }
}

}  // namespace theatron::synthetic
