// SPDX-License-Identifier: Apache-2.0
#include "synthetic/growing_loop.h"

#include <algorithm>

#include "base/error.h"
#include "base/log.h"
#include "base/thread_name.h"
#include "synthetic/loop_renderer.h"

namespace theatron::synthetic {
namespace {

struct Stopped {};

}  // namespace

GrowingLoop::GrowingLoop(const LoopOptions& options, std::size_t urgent, const Progress& progress)
    : options_(options), calibration_(loop_calibration(options)) {
    urgent = std::min(urgent, frames_of(options));
    if (auto cached = read_loop_index(loop_path(options), key_of(options))) {
        index_ = std::move(*cached);
        path_ = loop_path(options);
        file_.open(path_, std::ios::binary);
        return;
    }
    thread_ = std::jthread([this, urgent](const std::stop_token& stop) { render(stop, urgent); });
    wait_for_first(urgent, progress);
    if (!file_)
        throw Error("The synthetic room's cache '" + path_.string() + "' cannot be read back.");
}

GrowingLoop::~GrowingLoop() = default;

std::size_t GrowingLoop::frames() const {
    const std::lock_guard lock(mutex_);
    return index_.size();
}

void GrowingLoop::wait_for_first(std::size_t urgent, const Progress& progress) {
    std::unique_lock lock(mutex_);
    while (index_.size() < urgent) {
        if (is_over_)
            std::rethrow_exception(failure_);
        const std::string_view step = step_;
        // The steps before the first frame take a twentieth of the time of all.
        const double done = index_.empty() ? std::min(step_done_, 0.05)
                                           : 0.05 + 0.95 * double(index_.size()) / double(urgent);
        lock.unlock();
        if (progress && !step.empty())
            progress(step, done);
        lock.lock();
        if (index_.size() < urgent && !is_over_)
            changed_.wait(lock);
    }
}

void GrowingLoop::render(const std::stop_token& stop, std::size_t urgent) {
    name_this_thread("room renderer");
    try {
        LoopWriter out(loop_path(options_), key_of(options_), frames_of(options_));
        {
            const std::lock_guard lock(mutex_);
            path_ = out.draft();
            // Now, because the draft has another name once the loop is whole.
            file_.open(path_, std::ios::binary);
        }
        const auto take = [&](const EncodedFrame& frame) {
            const LoopEntry entry = out.add(frame);
            const std::lock_guard lock(mutex_);
            index_.push_back(entry);
            changed_.notify_all();
        };
        const auto tell = [&](std::string_view step, double done) {
            if (stop.stop_requested())
                throw Stopped();
            const std::lock_guard lock(mutex_);
            step_ = step;
            step_done_ = done;
            changed_.notify_all();
        };
        LoopRenderer(options_, take, tell, urgent).render();
        out.finish();
    } catch (const Stopped&) {
    } catch (const std::exception& error) {
        const std::lock_guard lock(mutex_);
        failure_ = std::current_exception();
        // Before the first frames, the caller hears of it.
        if (index_.size() >= urgent)
            log::warning("camera", "the generated room stays as short as it is",
                         {{"why", error.what()}});
    }
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    changed_.notify_all();
}

void GrowingLoop::read(std::size_t number, Frame& out) {
    LoopEntry entry;
    {
        const std::lock_guard lock(mutex_);
        entry = index_.at(number);
    }
    if (!read_loop_frame(file_, entry, calibration_.depth.size, calibration_.color.size, buffer_,
                         out))
        throw Error("The synthetic room's cache '" + path_.string() +
                    "' has been damaged; it will be rendered again at the next start.");
}

}  // namespace theatron::synthetic
