// SPDX-License-Identifier: Apache-2.0
// The state of a headset for one picture, in plain values, as WebXR tells it.
//
// All poses are in the tracking space: metres, y up, the floor at y = 0, parts look along -z.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/time.h"
#include "geometry/vec.h"
#include "image/view.h"

namespace theatron::xr {

// A picture of one eye: its tangents as in render::CameraView, and where it is drawn: a framebuffer
// by its name of GL (eyes share one, or each has its own), and the lower left corner (x, y) and
// size of its part there.
struct HeadsetEye {
    Pose floor_from_eye;
    double left = -1, right = 1, top = -1, bottom = 1;
    unsigned framebuffer = 0;
    int x = 0, y = 0;
    Size size;
};

// For a hand that cameras track.
struct HandJoints {
    Vec3 wrist, thumb_tip, index_tip, middle_tip, ring_tip;
};

// A controller, or a tracked hand if it has joints.
struct HandState {
    Pose floor_from_aim;                              // the ray starts there
    Pose floor_from_grip;                             // where the hand is
    double trigger = 0;                               // 0 to 1
    double squeeze = 0;                               // 0 to 1
    Vec2 stick;                                       // -1 to 1: x right, y away from the person
    bool lower_button = false, upper_button = false;  // A and B, or X and Y
    std::optional<HandJoints> joints;
};

enum Side { left_side, right_side };

struct HeadsetFrame {
    // From now until the picture is seen, as the runtime predicts it; poses are those of that
    // moment.
    Duration until_shown{};
    Pose floor_from_head;
    std::vector<HeadsetEye> eyes;                   // left, right; one on a flat display
    std::array<std::optional<HandState>, 2> hands;  // by Side; none: not tracked
};

}  // namespace theatron::xr
