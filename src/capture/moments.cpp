// SPDX-License-Identifier: Apache-2.0
#include "capture/moments.h"

#include <algorithm>
#include <cmath>

namespace theatron::capture {
namespace {

// Hysteresis, as a share of a period: a camera near the middle between two moments keeps to
// the moment after its last one, so that jitter does not move it back and forth.
constexpr double margin = 0.05;

// Largest correction of the beat per frame of the leading camera.
constexpr Duration most_correction = 2ms;

}  // namespace

Moments::Moments(double frames_per_second) : period_us_(1e6 / frames_per_second) {}

Moments::Tag Moments::tag(CameraId camera, TimePoint captured) {
    if (!begun_) {
        begun_ = true;
        leader_ = camera;
        beat_time_ = captured;
    }
    // Uses the times already returned for moments, since the beat may have been corrected
    // after them.
    const auto distance = [&](std::int64_t index) {
        return std::abs(double((captured - time_of(index)).count()));
    };
    Tag tag;
    const std::int64_t guess =
        beat_index_ + std::llround(double((captured - beat_time_).count()) / period_us_);
    tag.index = guess;
    for (const std::int64_t neighbour : {guess - 1, guess + 1})
        if (distance(neighbour) < distance(tag.index))
            tag.index = neighbour;

    const auto last = last_index_.find(camera);
    if (last != last_index_.end()) {
        if (distance(last->second + 1) <= (0.5 + margin) * period_us_)
            tag.index = last->second + 1;
        tag.pass_over = tag.index == last->second;
    }
    last_index_[camera] = tag.index;

    if (camera != leader_ && captured - beat_time_ > leader_patience)
        leader_ = camera;
    if (camera == leader_) {
        // A new leader has another phase; the beat approaches it in small steps.
        const TimePoint expected = estimate(tag.index);
        beat_time_ =
            expected + std::clamp<Duration>(captured - expected, -most_correction, most_correction);
        beat_index_ = tag.index;
    }
    tag.moment = time_of(tag.index);
    told_[std::size_t(tag.index) % remembered] = {tag.index, tag.moment};
    tag.offset = captured - tag.moment;
    return tag;
}

TimePoint Moments::estimate(std::int64_t index) const {
    return beat_time_ + Duration(std::llround(double(index - beat_index_) * period_us_));
}

TimePoint Moments::time_of(std::int64_t index) const {
    const Told& told = told_[std::size_t(index) % remembered];
    return told.index == index ? told.time : estimate(index);
}

}  // namespace theatron::capture
