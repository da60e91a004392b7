// SPDX-License-Identifier: Apache-2.0
#include "viewer/same_moment.h"

#include <algorithm>
#include <utility>

namespace theatron::viewer {

void SameMoment::add(receive::CameraFramePtr frame, TimePoint now) {
    Camera& camera = cameras_[frame->camera];
    const bool goes_back = camera.shown && frame->moment < camera.shown->moment;
    if (frame->past || goes_back || (camera.shown && camera.shown->past)) {
        // The picture jumps in time, and so do those of the other cameras.
        camera = {};
        moments_.clear();
    } else {
        note_arrival(frame->camera, frame->moment, now);
    }
    camera.arrived_at = now;
    camera.waiting.push_back({std::move(frame), now});
}

void SameMoment::remove(CameraId camera) {
    cameras_.erase(camera);
    moments_.clear();  // a session that begins anew has earlier ones
}

void SameMoment::note_arrival(CameraId camera, TimePoint moment, TimePoint now) {
    const auto known = std::find_if(moments_.begin(), moments_.end(),
                                    [&](const Moment& other) { return other.moment == moment; });
    if (known != moments_.end()) {
        known->arrivals.emplace(camera, now);
        return;
    }
    if (!moments_.empty() && moment < moments_.front().moment)
        return;
    const auto later = std::find_if(moments_.begin(), moments_.end(),
                                    [&](const Moment& other) { return other.moment > moment; });
    moments_.insert(later, {moment, now, {{camera, now}}});
    if (moments_.size() > open_moments)
        close_moment();
}

void SameMoment::close_moment() {
    const Moment& moment = moments_.front();
    for (auto& [id, camera] : cameras_) {
        const auto arrival = moment.arrivals.find(id);
        camera.lateness.push_back(arrival == moment.arrivals.end()
                                      ? std::nullopt
                                      : std::optional(arrival->second - moment.first_at));
        if (camera.lateness.size() > remembered)
            camera.lateness.pop_front();
    }
    moments_.pop_front();
}

bool SameMoment::is_live(const Camera& camera, TimePoint now) const {
    return camera.arrived_at != TimePoint{} && now - camera.arrived_at < silence;
}

bool SameMoment::is_waited_for(const Camera& camera, TimePoint now) const {
    if (!is_live(camera, now))
        return false;
    std::vector<Duration> lateness;
    std::size_t missed = 0;
    for (const auto& of_moment : camera.lateness)
        if (of_moment)
            lateness.push_back(*of_moment);
        else
            ++missed;
    if (missed > may_miss)
        return false;
    if (lateness.empty())
        return true;
    const auto middle = lateness.begin() + std::ptrdiff_t(lateness.size() / 2);
    std::nth_element(lateness.begin(), middle, lateness.end());
    return *middle <= usual_lateness;
}

bool SameMoment::has_or_had(const Camera& camera, TimePoint moment) const {
    return (camera.shown && camera.shown->moment >= moment) ||
           std::any_of(camera.waiting.begin(), camera.waiting.end(),
                       [&](const Arrived& a) { return a.frame->moment >= moment; });
}

std::vector<receive::CameraFramePtr> SameMoment::take(TimePoint now) {
    std::vector<receive::CameraFramePtr> frames;
    std::vector<const Camera*> waited_for;
    for (const auto& [id, camera] : cameras_)
        if (is_waited_for(camera, now))
            waited_for.push_back(&camera);
    // Decided for all before any is shown, so that the order of the cameras does not matter.
    std::map<CameraId, std::size_t> shown;  // the number of its frames that wait no more
    for (auto& [id, of_id] : cameras_) {
        const Camera& camera = of_id;  // a lambda cannot capture `of_id` everywhere
        const bool is_awaited =
            std::find(waited_for.begin(), waited_for.end(), &camera) != waited_for.end();
        for (std::size_t i = 0; i < camera.waiting.size(); ++i) {
            const Arrived& arrived = camera.waiting[i];
            const bool is_whole =
                std::all_of(waited_for.begin(), waited_for.end(), [&](const Camera* other) {
                    return other == &camera || has_or_had(*other, arrived.frame->moment);
                });
            const bool waits_in_vain = !is_whole && now - arrived.at >= patience;
            if (arrived.frame->past || is_whole || waits_in_vain || !is_awaited)
                shown[id] = i + 1;
        }
    }
    for (const auto& [id, count] : shown) {
        Camera& camera = cameras_.at(id);
        camera.shown = camera.waiting[count - 1].frame;
        camera.waiting.erase(camera.waiting.begin(),
                             camera.waiting.begin() + std::ptrdiff_t(count));
        frames.push_back(camera.shown);
    }
    return frames;
}

bool SameMoment::waits() const {
    return std::any_of(cameras_.begin(), cameras_.end(),
                       [](const auto& camera) { return !camera.second.waiting.empty(); });
}

std::optional<Duration> SameMoment::skew(TimePoint now) const {
    std::optional<TimePoint> first, last;
    std::size_t count = 0;
    for (const auto& [id, camera] : cameras_) {
        if (!camera.shown || camera.shown->past || !is_live(camera, now))
            continue;
        const TimePoint captured = camera.shown->times.captured;
        first = std::min(first.value_or(captured), captured);
        last = std::max(last.value_or(captured), captured);
        ++count;
    }
    return count < 2 ? std::nullopt : std::optional(*last - *first);
}

}  // namespace theatron::viewer
