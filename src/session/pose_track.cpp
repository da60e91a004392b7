// SPDX-License-Identifier: Apache-2.0
#include "session/pose_track.h"

#include <algorithm>

namespace theatron::session {
namespace {

constexpr std::size_t kept_poses = 16;
// Part of the difference by which the delay shrinks with each pose that is less late.
constexpr double shrinking = 0.02;

std::optional<wire::PartPose> between(const std::optional<wire::PartPose>& from,
                                      const std::optional<wire::PartPose>& to, double share) {
    if (!from || !to)
        return share < 1 ? from : to;
    return session::between(*from, *to, share);
}

Vec3 place_of(const wire::PartPose& part) {
    return {part.position[0], part.position[1], part.position[2]};
}

bool is_teleport(const wire::PersonPose& from, const wire::PersonPose& to) {
    if (!from.head || !to.head)
        return false;
    const double way = length(place_of(*to.head) - place_of(*from.head));
    return way > PoseTrack::teleport_distance &&
           way > PoseTrack::teleport_speed * to_seconds(to.time - from.time);
}

}  // namespace

Pose pose_of(const wire::PartPose& part) {
    const auto& [w, x, y, z] = part.rotation;
    return {{w, x, y, z}, place_of(part)};
}

wire::PartPose between(const wire::PartPose& from, const wire::PartPose& to, double share) {
    wire::PartPose result;
    for (std::size_t i = 0; i < 3; ++i)
        result.position[i] = float(from.position[i] + share * (to.position[i] - from.position[i]));
    double cosine = 0, norm = 0;
    for (std::size_t i = 0; i < 4; ++i)
        cosine += double(from.rotation[i]) * to.rotation[i];
    // q and -q are the same rotation; the shorter way is taken.
    const double sign = cosine < 0 ? -1 : 1;
    std::array<double, 4> mixed{};
    for (std::size_t i = 0; i < 4; ++i) {
        mixed[i] = (1 - share) * from.rotation[i] + share * sign * to.rotation[i];
        norm += mixed[i] * mixed[i];
    }
    if (norm < 1e-6)
        return {result.position, to.rotation};
    for (std::size_t i = 0; i < 4; ++i)
        result.rotation[i] = float(mixed[i] / std::sqrt(norm));
    return result;
}

void PoseTrack::add(const wire::PersonPose& pose, TimePoint now) {
    if (!poses_.empty() && pose.time <= poses_.back().time)
        return;
    if (!poses_.empty()) {
        const wire::PersonPose& last = poses_.back();
        if (is_teleport(last, pose))
            teleport_ = Teleport{place_of(*last.head), place_of(*pose.head), pose.time};
        // The next pose must have arrived when it is displayed.
        const Duration late = std::clamp(now - last.time, Duration{}, largest_delay);
        // After a pause without motion the interval says nothing about lateness.
        if (late > delay_ && pose.time - last.time < largest_delay)
            delay_ = late;
        else if (late < delay_)
            delay_ -= Duration(std::int64_t(double((delay_ - late).count()) * shrinking));
    }
    poses_.push_back(pose);
    if (poses_.size() > kept_poses)
        poses_.pop_front();
}

std::optional<wire::PersonPose> PoseTrack::at(TimePoint now) const {
    if (poses_.empty())
        return std::nullopt;
    const TimePoint shown = now - delay_;
    const auto after = std::find_if(poses_.begin(), poses_.end(),
                                    [&](const auto& pose) { return pose.time > shown; });
    if (after == poses_.begin())
        return poses_.front();
    const wire::PersonPose* from = &*(after - 1);
    const wire::PersonPose* to = after == poses_.end() ? nullptr : &*after;
    TimePoint time = shown;
    if (!to) {
        // The motion of the last two poses goes on.
        if (poses_.size() < 2)
            return poses_.back();
        from = &poses_[poses_.size() - 2];
        to = &poses_.back();
        if (to->time - from->time > extrapolation_time)
            return *to;
        time = std::min(shown, to->time + extrapolation_time);
    }
    if (is_teleport(*from, *to))
        return time < to->time ? *from : *to;
    const double share = to_seconds(time - from->time) / to_seconds(to->time - from->time);
    wire::PersonPose pose;
    pose.time = time;
    pose.calls = to->calls;
    pose.points = to->points;
    pose.head = between(from->head, to->head, share);
    pose.left_hand = between(from->left_hand, to->left_hand, share);
    pose.right_hand = between(from->right_hand, to->right_hand, share);
    return pose;
}

bool PoseTrack::is_moving(TimePoint now) const {
    return poses_.size() > 1 && now - delay_ < poses_.back().time + extrapolation_time &&
           poses_.back().head != poses_[poses_.size() - 2].head;
}

}  // namespace theatron::session
