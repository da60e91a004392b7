// SPDX-License-Identifier: Apache-2.0
// Moving through the room with mouse and keyboard: the viewpoint that follows from a
// person's input. The same for a window and for a browser.
//
// All functions are pure.
#pragma once

#include "base/time.h"
#include "geometry/vec.h"

namespace theatron::window {

// Where the eye is, and the point that it turns around. The eye is a camera: x
// right, y down, z forward.
struct Viewpoint {
    Pose room_from_eye;
    Vec3 pivot;
    bool operator==(const Viewpoint&) const = default;
};

// The same viewpoint with another pivot: the point at `place` in the plane one metre before the eye
// (x right, y down, metres), moved along its ray to `along_m` metres along the view's axis.
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

// The viewpoint after this input. Turning carries the eye around the pivot, and the
// scene follows the mouse; it stops before the picture would be upside down. Sliding keeps
// the pivot under the mouse. Flying takes the pivot along.
// `view_height` is the height of the picture one metre before the eye, in metres;
// `elapsed` is the time for which the keys were down.
Viewpoint steered(const Viewpoint& from, const Steering& steering, double view_height,
                  Duration elapsed);

}  // namespace theatron::window
