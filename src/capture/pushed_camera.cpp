// SPDX-License-Identifier: Apache-2.0
#include "capture/pushed_camera.h"

#include <algorithm>

#include "base/steady_clock.h"
#include "capture/json_fields.h"
#include "video/jpeg_header.h"

namespace theatron::capture {
namespace {

// "Depth is 4x3, but ..."; empty if the sizes are equal.
std::string size_problem(const char* what, Size found, Size wanted) {
    if (found == wanted)
        return "";
    return std::string(what) + " is " + to_text(found) + ", but the camera's calibration says " +
           (wanted == Size{} ? "that it has none" : to_text(wanted)) + ".";
}

std::string problem_of(const Frame& frame, const Calibration& calibration) {
    std::string problem = size_problem("Depth", frame.depth.size, calibration.depth.size);
    if (!problem.empty() || frame.color.empty())
        return problem;
    if (!frame.color.is_jpeg())
        return size_problem("Colour", frame.color.pixels.size, calibration.color.size);
    const Result<Size> size = video::read_jpeg_size(frame.color.jpeg);
    return size ? size_problem("Colour", *size, calibration.color.size)
                : "The JPEG picture is " + std::string(theatron::to_text(size.error())) + ".";
}

class PushedCamera final : public Camera {
public:
    explicit PushedCamera(std::shared_ptr<PushedFrames> frames) : frames_(std::move(frames)) {}

    const CameraInfo& info() const override { return frames_->info(); }
    Capture next(Duration timeout) override { return frames_->take(timeout); }

private:
    const std::shared_ptr<PushedFrames> frames_;
};

}  // namespace

std::string PushedFrames::push(std::shared_ptr<Frame> frame, TimePoint captured) {
    if (std::string problem = problem_of(*frame, info_.calibration); !problem.empty())
        return problem;
    {
        const std::lock_guard lock(mutex_);
        if (last_captured_ && captured <= *last_captured_)
            return "A frame is captured after the one before it.";
        last_captured_ = captured;
        frame->number = number_++;
        frame->times = {};
        frame->times.captured = captured;
        frame->times.delivered = std::max(captured, steady_now());
        frame->color.size =
            frame->color.is_jpeg() ? info_.calibration.color.size : frame->color.pixels.size;
        replaced_ += waiting_ != nullptr;
        waiting_ = std::move(frame);
    }
    changed_.notify_all();
    return "";
}

void PushedFrames::end(std::string problem) {
    {
        const std::lock_guard lock(mutex_);
        has_ended_ = true;
        problem_ = std::move(problem);
    }
    changed_.notify_all();
}

Capture PushedFrames::take(Duration timeout) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [&] { return waiting_ || has_ended_; });
    if (waiting_)
        return {.kind = Capture::Kind::frame, .frame = std::exchange(waiting_, nullptr)};
    if (!has_ended_)
        return {};
    return {.kind = problem_.empty() ? Capture::Kind::end : Capture::Kind::failed,
            .problem = problem_};
}

std::uint64_t PushedFrames::replaced() const {
    const std::lock_guard lock(mutex_);
    return replaced_;
}

std::unique_ptr<Camera> make_pushed_camera(std::shared_ptr<PushedFrames> frames) {
    return std::make_unique<PushedCamera>(std::move(frames));
}

}  // namespace theatron::capture
