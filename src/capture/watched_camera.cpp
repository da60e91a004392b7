// SPDX-License-Identifier: Apache-2.0
#include "capture/watched_camera.h"

#include <algorithm>

#include "base/error.h"
#include "geometry/screen.h"

namespace theatron::capture {
namespace {

using wire::CameraCondition;

// Interval at which a closed camera is checked for opening.
constexpr Duration closed_pause = 20ms;

CameraCare::Options care_options(const CameraInfo& info, bool patient) {
    return {seconds_to_duration(1 / info.frames_per_second), info.live, patient};
}

wire::Text text_of(Trouble trouble, const std::string& problem) {
    using wire::TextCode;
    switch (trouble) {
        case Trouble::none:
            return {};
        case Trouble::silent:
            return {TextCode::camera_silent};
        case Trouble::repeating:
            return {TextCode::camera_repeating};
        case Trouble::time_jump:
            return {TextCode::camera_time_jump};
        case Trouble::gone:
            break;
    }
    return problem.empty() ? wire::Text{TextCode::camera_gone} : wire::as_written(problem);
}

wire::Text lost_text(std::uint64_t pictures) {
    if (pictures == 1)
        return {wire::TextCode::recording_lost_one};
    return {wire::TextCode::recording_lost_pictures, {std::to_string(pictures)}};
}

}  // namespace

PictureMark mark_of(DepthView depth) {
    // Samples enough pixels that a sensor's noise changes at least one.
    constexpr int rows_apart = 13, columns_apart = 11;
    std::uint64_t hash = 0xcbf29ce484222325, any = 0;
    for (int y = 0; y < depth.size.height; y += rows_apart) {
        const std::uint16_t* row = depth.row(y);
        for (int x = 0; x < depth.size.width; x += columns_apart) {
            any |= row[x];
            hash = (hash ^ row[x]) * 0x100000001b3;
        }
    }
    return {any == 0 ? 0 : hash | 1};
}

WatchedCamera::WatchedCamera(std::unique_ptr<Camera> camera, Open open_again, Clock clock,
                             bool patient)
    : info_(camera->info()),
      open_again_(std::move(open_again)),
      clock_(std::move(clock)),
      patient_(patient),
      camera_(std::move(camera)),
      care_(care_options(info_, patient), clock_.now()) {}

WatchedCamera::Turn WatchedCamera::turn() const {
    const std::lock_guard lock(mutex_);
    return Turn(turn_);
}

WatchedCamera::Step WatchedCamera::step(Turn turn, Duration timeout) {
    std::shared_ptr<Camera> camera;
    bool open_now = false;
    {
        const std::lock_guard lock(mutex_);
        if (over_ || unsigned(turn) != turn_)
            return {nullptr, true};
        const TimePoint now = clock_.now();
        care_.on_time(now);
        open_now = open_again_ && care_.wants_reopen(now);
        if (open_now || camera_)
            entered_driver_ = now;
        opening_ = open_now;
        camera = open_now ? std::exchange(camera_, nullptr) : camera_;
    }
    if (open_now) {
        // The old handle is closed first: a device cannot be opened twice.
        camera.reset();
        return reopen(turn);
    }
    if (!camera) {
        clock_.sleep(std::min(timeout, closed_pause));
        return {};
    }
    return take(turn, *camera, timeout);
}

WatchedCamera::Step WatchedCamera::reopen(Turn turn) {
    std::shared_ptr<Camera> camera;
    std::string problem;
    try {
        camera = open_again_();
        const Calibration& found = camera->info().calibration;
        if (found.depth.size != info_.calibration.depth.size ||
            found.color.size != info_.calibration.color.size)
            throw Error("What was found in its place is another camera.");
    } catch (const std::exception& e) {
        problem = e.what();
        camera.reset();
    }
    const std::lock_guard lock(mutex_);
    if (unsigned(turn) != turn_)
        return {nullptr, true};
    entered_driver_ = {};
    const TimePoint now = clock_.now();
    if (camera)
        care_.on_opened(now);
    else
        care_.on_open_failed(problem, now);
    camera_ = std::move(camera);
    return {};
}

WatchedCamera::Step WatchedCamera::take(Turn turn, Camera& camera, Duration timeout) {
    const Capture got = camera.next(timeout);
    // The depth of a screen never changes.
    const bool has_noise = info_.live && !is_screen(info_.calibration);
    const PictureMark mark = got.kind == Capture::Kind::frame && has_noise
                                 ? mark_of(got.frame->depth.view())
                                 : PictureMark{};
    const std::uint64_t lost = camera.lost_pictures();

    std::shared_ptr<Camera> closing;  // destroyed outside the lock
    const std::lock_guard lock(mutex_);
    if (unsigned(turn) != turn_)
        return {nullptr, true};
    entered_driver_ = {};
    note_lost(lost, got.kind == Capture::Kind::end);
    switch (got.kind) {
        case Capture::Kind::frame: {
            const FrameTimes& times = got.frame->times;
            rests_ = false;
            if (care_.on_frame(times.captured, times.delivered, mark))
                return {got.frame, false};
            return {};
        }
        case Capture::Kind::nothing:
            care_.on_time(clock_.now());
            return {};
        case Capture::Kind::end:
            rests_ = got.may_go_on;
            if (rests_)
                return {};
            return end(CameraCondition::ended, got.problem);
        case Capture::Kind::failed:
            if (!info_.live || !open_again_)
                return end(CameraCondition::failed, got.problem);
            care_.on_gone(got.problem, clock_.now());
            closing = std::move(camera_);
            return {};
    }
    return {};
}

// Not with every picture of a recording that is all damage.
void WatchedCamera::note_lost(std::uint64_t pictures, bool at_once) {
    constexpr Duration interval = 1s;
    const TimePoint now = clock_.now();
    if (pictures == lost_pictures_ ||
        (lost_pictures_ > 0 && now - lost_noted_ < interval && !at_once))
        return;
    lost_pictures_ = pictures;
    lost_noted_ = now;
}

WatchedCamera::Step WatchedCamera::end(CameraCondition how, std::string problem) {
    over_ = true;
    how_over_ = how;
    problem_ = std::move(problem);
    return {nullptr, true};
}

WatchedCamera::Turn WatchedCamera::abandon() {
    const std::lock_guard lock(mutex_);
    camera_.reset();  // the hanging thread owns the camera until it returns
    entered_driver_ = {};
    care_.on_gone("Its driver does not come back.", clock_.now());
    return Turn(++turn_);
}

void WatchedCamera::forgive() {
    const std::lock_guard lock(mutex_);
    if (entered_driver_ != TimePoint{})
        entered_driver_ = clock_.now();
}

WatchedCamera::Status WatchedCamera::status() const {
    const std::lock_guard lock(mutex_);
    const TimePoint now = clock_.now();
    Status status;
    if (over_) {
        status.condition = how_over_;
        status.problem = wire::as_written(problem_);
    } else {
        care_.on_time(now);
        status.condition = care_.stale() ? CameraCondition::stale : CameraCondition::live;
        status.trouble = care_.trouble();
        status.problem = text_of(status.trouble, care_.problem());
    }
    if (rests_ && !over_) {
        status.condition = CameraCondition::ended;
        status.trouble = Trouble::none;
        status.problem = {};
    }
    status.lost_pictures = lost_pictures_;
    if (status.problem.empty() && lost_pictures_ > 0)
        status.problem = lost_text(lost_pictures_);
    status.figures = care_.figures();
    status.without_picture = now - care_.last_good();
    status.hangs = !patient_ && entered_driver_ != TimePoint{} &&
                   now - entered_driver_ > (opening_ ? longest_opening : longest_call);
    return status;
}

}  // namespace theatron::capture
