// SPDX-License-Identifier: Apache-2.0
#include "host/gain_watch.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "base/fault.h"
#include "base/log.h"
#include "base/thread_name.h"
#include "geometry/screen.h"
#include "send/lane_encoders.h"

namespace theatron::host {
namespace {

constexpr int niceness_of_watch = 15;  // niceness
// A camera that gives no picture for this time is not in this round.
constexpr Duration round_length = std::chrono::seconds(1);
// Soon at first, so that viewers get gains before they have settled on their own.
constexpr Duration first_pause = std::chrono::seconds(1), later_pause = std::chrono::seconds(10);
constexpr int first_rounds = 30;
// The pause, in multiples of the processor time of the round: at most 1 % of a core is used, with
// pictures of any size.
constexpr int idle_share = 100;

bool is_comparable(const Calibration& calibration) {
    return calibration.registered && calibration.person == 0 && calibration.color.size.area() > 0 &&
           !is_screen(calibration);
}

}  // namespace

GainWatch::GainWatch(const std::vector<capture::CameraInfo>& cameras, Publish publish,
                     std::function<TimePoint()> now)
    : publish_(std::move(publish)), now_(std::move(now)), gains_(cameras.size()) {
    bool has_unknown = false;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const Calibration& calibration = cameras[i].calibration;
        if (calibration.color_gain)
            gains_[i] = Gain{*calibration.color_gain, false};
        if (!is_comparable(calibration))
            continue;
        watched_[i] = calibration;
        places_[i] = calibration.room_from_camera;
        has_unknown = has_unknown || !calibration.color_gain;
    }
    if (watched_.size() < 2 || !has_unknown)
        return;
    begin_round(now_());
    thread_ = std::thread([this] { run(); });
}

GainWatch::~GainWatch() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable())
        thread_.join();
}

// The mutex is held, or no thread runs yet.
void GainWatch::begin_round(TimePoint begin) {
    round_begin_ = begin;
    for (const auto& [camera, calibration] : watched_)
        wanted_.insert(camera);
}

void GainWatch::offer(std::size_t camera, const FramePtr& frame) {
    {
        const std::lock_guard lock(mutex_);
        if (!wanted_.contains(camera) || frame->times.captured < round_begin_ ||
            frame->color.empty())
            return;
        wanted_.erase(camera);
        waiting_[camera] = frame;
    }
    changed_.notify_one();
}

void GainWatch::correct_place(std::size_t camera, const Pose& room_from_camera) {
    const std::lock_guard lock(mutex_);
    places_[camera] = room_from_camera;
}

GainWatch::Gains GainWatch::gains() const {
    const std::lock_guard lock(mutex_);
    return gains_;
}

void GainWatch::run() {
    name_this_thread("gain watch");
    setpriority(PRIO_PROCESS, id_t(gettid()), niceness_of_watch);
    std::unique_lock lock(mutex_);
    while (true) {
        const TimePoint end = round_begin_ + round_length;
        changed_.wait_for(lock, end - now_(), [this] { return stopping_ || !waiting_.empty(); });
        if (stopping_)
            return;
        if (!waiting_.empty()) {
            const auto [camera, frame] = *waiting_.begin();
            waiting_.erase(waiting_.begin());
            const Pose place = places_[camera];
            lock.unlock();
            const Duration begin = send::thread_cpu_time();
            (void)contain("gain watch", [&, n = camera, &f = *frame] { look_at(n, f, place); });
            round_cpu_ += send::thread_cpu_time() - begin;
            lock.lock();
        }
        if (!waiting_.empty() || (!wanted_.empty() && now_() < end))
            continue;
        lock.unlock();
        end_round();
        lock.lock();
    }
}

void GainWatch::look_at(std::size_t camera, const Frame& frame, const Pose& room_from_camera) {
    Calibration calibration = watched_.at(camera);
    calibration.room_from_camera = room_from_camera;
    ColorView color = frame.color.pixels.view();
    if (frame.color.is_jpeg()) {
        if (jpeg_.decompress(frame.color.jpeg, decoded_) != Status::ok)
            return;
        color = decoded_.view();
    }
    if (frame.depth.size != calibration.depth.size)
        return;
    balance_.add(CameraId(camera), calibration, frame.depth.view(), color);
    seen_.insert(camera);
}

void GainWatch::end_round() {
    const Duration begin = send::thread_cpu_time();
    (void)contain("gain watch", [this] { estimate(); });
    seen_.clear();
    decoded_ = {};
    ++rounds_;
    const bool is_first = !settled_.has_published() && rounds_ < first_rounds;
    const Duration took = std::exchange(round_cpu_, {}) + send::thread_cpu_time() - begin;
    const Duration pause = std::max(is_first ? first_pause : later_pause, took * idle_share);
    const std::lock_guard lock(mutex_);
    begin_round(now_() + pause);
}

void GainWatch::estimate() {
    // The last picture of a camera that gives no more is not compared with those of now.
    for (const auto& [camera, calibration] : watched_)
        if (!seen_.contains(camera))
            balance_.remove(CameraId(camera));
    const SettledGains::Gains& before = settled_.published();
    for (std::size_t i = 0; i < before.size(); ++i)
        if (before[i] && seen_.contains(i))
            balance_.set_usual_gain(CameraId(i), *before[i]);
    if (!balance_.update())
        return;
    SettledGains::Gains estimate(gains_.size());
    for (const std::size_t camera : seen_)
        estimate[camera] = balance_.newest_gain(CameraId(camera));
    const SettledGains::Gains settled = settled_.add(estimate, now_());
    if (settled.empty())
        return;
    {
        const std::lock_guard lock(mutex_);
        for (std::size_t i = 0; i < settled.size(); ++i)
            if (settled[i])
                gains_[i] = Gain{*settled[i], true};
    }
    publish_(settled);
}

}  // namespace theatron::host
