// SPDX-License-Identifier: Apache-2.0
// The poses of a person's head and hands: the state of topic `pose`
// (docs/formats/person_pose.md).
#pragma once

#include <array>
#include <optional>

#include "base/bytes.h"
#include "base/status.h"
#include "base/time.h"

namespace theatron::wire {

// room_from_part: a position in metres and a rotation as a unit quaternion, in the room's frame.
struct PartPose {
    std::array<float, 3> position{};            // x, y, z
    std::array<float, 4> rotation{1, 0, 0, 0};  // w, x, y, z
    bool operator==(const PartPose&) const = default;
};

struct PersonPose {
    TimePoint time;  // session time that the pose is for
    std::optional<PartPose> head, left_hand, right_hand;
    bool calls = false;   // asks the others to come
    bool points = false;  // the right hand, if there is one, points at something
    bool operator==(const PersonPose&) const = default;
};

inline constexpr float max_pose_distance = 1000;  // metres from the room's origin, on each axis

// Rotations are rounded to 1/32767 in each component. Positions are finite and not beyond
// max_pose_distance, rotations not zero.
Bytes encode_person_pose(const PersonPose& pose);

// Safe for untrusted input. Rotations that come out are unit quaternions.
Result<PersonPose> decode_person_pose(ByteView bytes);

}  // namespace theatron::wire
