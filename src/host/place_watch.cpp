// SPDX-License-Identifier: Apache-2.0
#include "host/place_watch.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "base/fault.h"
#include "base/log.h"
#include "base/thread_name.h"
#include "geometry/screen.h"

namespace theatron::host {
namespace {

using registration::RigWatch;

constexpr int niceness = 15;
// Images of each camera that must show another size of an alarm before it is told.
constexpr int images_to_tell = 4;

// A camera in the room whose place is known. The depth of a screen shows nothing of the room.
bool is_watchable(const Calibration& calibration) {
    return calibration.registered && calibration.person == 0 && !is_screen(calibration);
}

std::vector<std::size_t> watchable(const std::vector<capture::CameraInfo>& cameras) {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < cameras.size(); ++i)
        if (is_watchable(cameras[i].calibration))
            numbers.push_back(i);
    return numbers;
}

RigWatch make_watch(const std::vector<capture::CameraInfo>& cameras,
                    const std::vector<std::size_t>& watched) {
    std::vector<RigWatch::Camera> about;
    for (const std::size_t i : watched) {
        const Calibration& c = cameras[i].calibration;
        about.push_back(
            {c.depth, c.depth_unit_mm, c.room_from_camera, c.depth_offset_mm.value_or(0) / 1000});
    }
    return RigWatch(about);
}

}  // namespace

PlaceWatch::PlaceWatch(const std::vector<capture::CameraInfo>& cameras, Alarm alarm)
    : cameras_(cameras),
      alarm_(std::move(alarm)),
      watched_(watchable(cameras)),
      watch_(make_watch(cameras, watched_)),
      told_(watched_.size()),
      renewals_(watched_.size()),
      taken_(watched_.size()) {
    figures_.cameras.resize(cameras.size());
    for (const std::size_t i : watched_)
        figures_.cameras[i].has_place = true;
    if (!watched_.empty())
        thread_ = std::thread([this] { run(); });
}

PlaceWatch::~PlaceWatch() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable())
        thread_.join();
}

std::optional<std::size_t> PlaceWatch::number_of(std::size_t camera) const {
    const auto found = std::lower_bound(watched_.begin(), watched_.end(), camera);
    if (found == watched_.end() || *found != camera)
        return std::nullopt;
    return std::size_t(found - watched_.begin());
}

void PlaceWatch::offer(std::size_t camera, const FramePtr& frame) {
    const auto number = number_of(camera);
    if (!number)
        return;
    {
        const std::lock_guard lock(mutex_);
        const TimePoint captured = frame->times.captured;
        TimePoint& taken = taken_[*number];
        if (captured - taken < watch_.period() && captured >= taken)
            return;
        taken = captured;
        waiting_[*number] = frame;
    }
    changed_.notify_one();
}

void PlaceWatch::correct_place(std::size_t camera, const Pose& room_from_camera) {
    const auto number = number_of(camera);
    if (!number)
        return;
    {
        const std::lock_guard lock(mutex_);
        corrected_[*number] = room_from_camera;
    }
    changed_.notify_one();
}

void PlaceWatch::accept_place(std::size_t camera) {
    const auto number = number_of(camera);
    if (!number)
        return;
    {
        const std::lock_guard lock(mutex_);
        accepted_.insert(*number);
    }
    changed_.notify_one();
}

PlaceWatch::Figures PlaceWatch::figures() const {
    const std::lock_guard lock(mutex_);
    return figures_;
}

void PlaceWatch::run() {
    name_this_thread("place watch");
    setpriority(PRIO_PROCESS, id_t(gettid()), niceness);
    while (true) {
        std::size_t number = 0;
        FramePtr frame;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] {
                return stopping_ || !waiting_.empty() || !corrected_.empty() || !accepted_.empty();
            });
            if (stopping_)
                return;
            if (!corrected_.empty() || !accepted_.empty()) {
                const auto corrected = std::exchange(corrected_, {});
                const auto accepted = std::exchange(accepted_, {});
                lock.unlock();
                (void)contain("place watch", [&] {
                    for (const auto& [camera, pose] : corrected)
                        watch_.correct_place(camera, pose);
                    for (const std::size_t camera : accepted)
                        if (watch_.motion(camera).is_alarm)
                            watch_.accept_place(camera);
                    tell();
                });
                continue;
            }
            const auto first = waiting_.begin();
            number = first->first;
            frame = std::move(first->second);
            waiting_.erase(first);
        }
        (void)contain("place watch", [&] { look_at(number, *frame); });
    }
}

void PlaceWatch::look_at(std::size_t number, const Frame& frame) {
    watch_.add(number, frame.depth.view(), frame.times.captured);
    tell();
}

void PlaceWatch::tell() {
    Figures figures;
    figures.cameras.resize(cameras_.size());
    for (std::size_t i = 0; i < watched_.size(); ++i) {
        const RigWatch::Motion& motion = watch_.motion(i);
        figures.cameras[watched_[i]] = {true,
                                        motion.is_known || motion.is_alarm,
                                        motion.is_alarm,
                                        motion.is_covered,
                                        motion.is_far,
                                        motion.moved_m * 1000,
                                        motion.turned_deg,
                                        problem(i)};
        if (std::exchange(renewals_[i], motion.renewals) != motion.renewals)
            log::warning("place watch",
                         "what the camera sees has moved as one, but the room behind it, or a "
                         "camera that stands still, shows that the scene moved; the camera is "
                         "compared with what it sees now",
                         {{"camera", int(watched_[i])}});
    }
    for (const RigWatch::Pair& pair : watch_.pairs())
        figures.pairs.push_back(
            {watched_[pair.a], watched_[pair.b], pair.apart_m * 1000, pair.is_alarm});
    {
        const std::lock_guard lock(mutex_);
        figures_ = std::move(figures);
    }
    for (std::size_t i = 0; i < watched_.size(); ++i) {
        Told& told = told_[i];
        const wire::Text now = problem(i);
        const double now_m = size_m(i);
        // While a camera is being moved, or put back, sizes of single images say little.
        const bool is_another = now_m > 2 * told.size_m || 2 * now_m < told.size_m;
        told.images_of_another = is_another ? told.images_of_another + 1 : 0;
        if (now.code == told.problem.code &&
            told.images_of_another < images_to_tell * int(watched_.size()))
            continue;
        told = {now, now_m, 0};
        alarm_(CameraId(watched_[i]), now);
    }
}

// The size that problem() names; 0: it names none.
double PlaceWatch::size_m(std::size_t number) const {
    const RigWatch::Motion& motion = watch_.motion(number);
    if (motion.is_far)
        return RigWatch::far_m;
    if (motion.is_alarm)
        return motion.moved_m;
    const RigWatch::Pair* pair = watch_.wrong_pair(number);
    return pair ? pair->apart_m : 0;
}

wire::Text PlaceWatch::problem(std::size_t number) const {
    const auto text = [](const char* format, double value) {
        char buffer[40];
        std::snprintf(buffer, sizeof(buffer), format, value);
        return std::string(buffer);
    };
    const RigWatch::Motion& motion = watch_.motion(number);
    if (motion.is_far)
        return {wire::TextCode::camera_moved_far,
                {text("%.0f", RigWatch::far_m * 1000), cameras_[watched_[number]].name}};
    if (motion.is_alarm && motion.together_with)
        return {wire::TextCode::camera_moved_together,
                {text("%.1f", motion.moved_m * 1000), text("%.2f", motion.turned_deg),
                 cameras_[watched_[*motion.together_with]].name, cameras_[watched_[number]].name}};
    if (motion.is_alarm)
        return {wire::TextCode::camera_moved,
                {text("%.1f", motion.moved_m * 1000), text("%.2f", motion.turned_deg)}};
    const RigWatch::Pair* pair = watch_.wrong_pair(number);
    if (!pair)
        return {motion.is_covered ? wire::TextCode::camera_covered : wire::TextCode::none, {}};
    const std::size_t other = pair->a == number ? pair->b : pair->a;
    return {wire::TextCode::cameras_apart,
            {cameras_[watched_[other]].name, text("%.0f", pair->apart_m * 1000)}};
}

}  // namespace theatron::host
