// SPDX-License-Identifier: Apache-2.0
// The poses of one other person for display: interpolated between the poses that arrived, briefly
// extrapolated where the next one is late, and not interpolated over a teleport.
//
// A pure state machine; times are session times of the participant that displays the person.
#pragma once

#include <deque>
#include <optional>

#include "geometry/vec.h"
#include "wire/person_pose.h"

namespace theatron::session {

class PoseTrack {
public:
    // A pose moves on past the newest one that arrived for this long at most, then it stops.
    static constexpr Duration extrapolation_time = std::chrono::milliseconds(100);
    // Upper bound of the playout delay, however late poses arrive.
    static constexpr Duration largest_delay = std::chrono::milliseconds(150);
    // Two poses that follow each other at a higher speed of the head (metres a second) and over a
    // longer way (metres) than these belong to a teleport.
    static constexpr double teleport_speed = 12, teleport_distance = 0.8;

    // A pose that arrived at `now`. Poses that are not newer than the last one are ignored.
    void add(const wire::PersonPose& pose, TimePoint now);

    // The pose at `now`, delayed by as much as poses were late recently. Nothing before the first.
    std::optional<wire::PersonPose> at(TimePoint now) const;
    // The time of the newest pose that arrived; the displayed one may be older.
    TimePoint newest() const { return poses_.empty() ? TimePoint{} : poses_.back().time; }
    // True while at() changes although no pose arrives.
    bool is_moving(TimePoint now) const;

    // The last teleport, if there was one: places of the head, and when it was displayed.
    struct Teleport {
        Vec3 from, to;
        TimePoint at;  // the session time of the first pose after it
        bool operator==(const Teleport&) const = default;
    };
    const std::optional<Teleport>& teleport() const { return teleport_; }
    // The time that is subtracted from the present for display.
    Duration delay() const { return delay_; }

private:
    std::deque<wire::PersonPose> poses_;  // the newest ones, oldest first
    Duration delay_{};
    std::optional<Teleport> teleport_;
};

Pose pose_of(const wire::PartPose& part);

// Between two poses of a part: 0 is `from`, 1 is `to`; outside of that range the motion goes on.
wire::PartPose between(const wire::PartPose& from, const wire::PartPose& to, double share);

}  // namespace theatron::session
