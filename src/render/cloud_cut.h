// SPDX-License-Identifier: Apache-2.0
// The part of a camera's cloud that is drawn: of a participant's own camera only the person, and
// of the viewer's own body nothing that blocks the view. Every renderer fades out at the borders.
#pragma once

#include <optional>

#include "geometry/vec.h"

namespace theatron::render {

struct CloudCut {
    // Only points in this ball of the room are drawn.
    struct Ball {
        Vec3 middle;
        double radius_m = 0;
        bool operator==(const Ball&) const = default;
    };
    // Points within this distance of a line in the room are not drawn.
    struct Capsule {
        Vec3 from, to;
        double radius_m = 0;
        bool operator==(const Capsule&) const = default;
    };
    std::optional<Ball> keep;
    std::optional<Capsule> remove;
    double border_m = 0.08;  // how wide the borders are

    bool operator==(const CloudCut&) const = default;
};

// The head's frame is that of the eye: x right, y down, z forward, between the eyes.

// The middle of the body that belongs to this head, in room coordinates: vertically below the
// neck, for any direction of the head.
Vec3 body_middle(const Pose& room_from_head);

// Distance from a body's middle to its farthest point.
inline constexpr double usual_reach_m = 1.1;

// Keeps another person in their cameras' pictures: points farther than `reach_m` from the body's
// middle belong to the room and are removed.
CloudCut other_person(const Pose& room_from_head, double reach_m = usual_reach_m);

// Head and headset, without the neck: what is removed where another head is drawn.
CloudCut::Capsule head_of(const Pose& room_from_head);

// As other_person() for the viewer's own body; also removes the headset, the head and points so
// near the eyes that they would hide everything else. Hands at work stay.
CloudCut oneself(const Pose& room_from_head, double reach_m = usual_reach_m);

}  // namespace theatron::render
