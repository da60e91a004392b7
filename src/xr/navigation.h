// SPDX-License-Identifier: Apache-2.0
// Moving through the room with mouse and keyboard: where the eye goes for what a
// person did. The same for a window and for a browser.
//
// All functions are pure.
#pragma once

#include "base/time.h"
#include "geometry/vec.h"

namespace theatron::xr {

// Where the eye is, and the point that it turns around. The eye is a camera: x
// right, y down, z forward.
struct Viewpoint {
    Pose room_from_eye;
    Vec3 pivot;
    bool operator==(const Viewpoint&) const = default;
};

// The viewpoint that turns around what is seen at `place`, given in the picture one metre before
// the eye (x right, y down, metres), in the distance `along_m` along the view's axis.
Viewpoint around(const Viewpoint& from, Vec2 place, double along_m);

// A person's input since the last call. Mouse movements are in heights of the window,
// x to the right and y down, so that they mean the same at every window size.
struct Steering {
    Vec2 turn;            // dragged with the left button
    Vec2 slide;           // dragged with the right or the middle one
    double approach = 0;  // clicks of the wheel, positive moves closer
    Vec3 fly;             // keys held, -1 to 1: x right, y up in the room, z forward
    bool fast = false;

    bool operator==(const Steering&) const = default;
    bool moves() const;
};

// The viewpoint after that. Turning carries the eye around the pivot, and the
// scene follows the mouse; it stops before the picture would be upside down. Sliding keeps
// the pivot under the mouse. Flying takes the pivot along.
// `view_height` is the height of the picture one metre before the eye, in metres;
// `elapsed` is how long the keys were held.
Viewpoint steered(const Viewpoint& from, const Steering& steering, double view_height,
                  Duration elapsed);

}  // namespace theatron::xr
