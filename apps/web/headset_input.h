// SPDX-License-Identifier: Apache-2.0
// A frame of a headset as page/headset.js writes it.
//
// 32-bit floats in the machine's order. A pose is x, y, z, and a quaternion x, y, z, w.
//   milliseconds until the picture is shown, 0 if the browser does not say
//   head: pose
//   number of eyes; for each: x, y, width, height of its part of the framebuffer, the four parts of
//     the projection that a frustum needs (columns 0, 5, 8, 9 of the matrix), pose
//   left hand, right hand: 0, or 1 for a controller and 2 for a bare hand, then ray: pose, grip:
//     pose, trigger, squeeze, stick: x and y (positive towards the person), lower button, upper
//     button; of a bare hand then the places of wrist, thumb, index, middle and ring finger
#pragma once

#include <optional>

#include "base/bytes.h"
#include "xr/headset_frame.h"

namespace theatron::web {

// Safe for any bytes: nothing if they are too few, too many, or not finite.
std::optional<xr::HeadsetFrame> read_headset_frame(ByteView bytes);
// The same for a single pose.
std::optional<Pose> read_headset_pose(ByteView bytes);

}  // namespace theatron::web
