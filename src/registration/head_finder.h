// SPDX-License-Identifier: Apache-2.0
// A person's head in one depth image, so that a single camera is placed relative to the person it
// sees.
//
// A head is a ball of known size that stands free to both sides and above, on shoulders. The ball
// gives the position; the shoulders, which are wider than deep, the direction of the body. The head
// may be turned on the body, which depth does not tell: the uncertainty says so.
#pragma once

#include <optional>

#include "registration/surface_grid.h"

namespace theatron::registration {

struct FoundHead {
    // Head frame: between the eyes, x to the person's right, y down, z forward.
    Pose camera_from_head;
    // Covariance of rotation about the head's axes (radians), then translation along them (metres).
    Matrix6 covariance = Matrix6::Zero();
    Vec3 middle;          // of the head, camera frame, metres
    double middle_m = 0;  // its deviation
    double share = 0;     // of the ball's visible side that lies on the ball, 0 to 1
};

// The nearest head 0.4 to 4 m away that is seen from the front or the side, with most of it in the
// picture. `up` points up, in the camera's frame; it need not be accurate. Empty if there is none.
std::optional<FoundHead> find_head(const SurfaceCamera& camera, DepthView depth,
                                   Vec3 up = {0, -1, 0});

// Where the camera is, if the person's head is there. Both head frames as above.
inline Pose room_from_camera(const Pose& room_from_head, const FoundHead& head) {
    return room_from_head * inverse(head.camera_from_head);
}

}  // namespace theatron::registration
