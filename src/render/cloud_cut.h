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

// Where the middle of a body is whose head is there: below the neck, upright whichever way
// the head is turned.
Vec3 body_middle(const Pose& room_from_head);

// How far a body reaches from its middle.
inline constexpr double usual_reach_m = 1.1;

// Another person, as their cameras see them: what is further than `reach_m` from the body's middle
// is the room behind.
CloudCut other_person(const Pose& room_from_head, double reach_m = usual_reach_m);

// Oneself: the headset, the head and what is so near before the eyes that it hides all else. Hands
// at work stay.
CloudCut oneself(const Pose& room_from_head, double reach_m = usual_reach_m);

}  // namespace theatron::render
