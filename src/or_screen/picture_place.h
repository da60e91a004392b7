// SPDX-License-Identifier: Apache-2.0
// Where a place of the room is in a camera's colour picture, and whether the camera sees it there.
//
// Pure functions; room coordinates, metres.
#pragma once

#include "geometry/calibration.h"
#include "image/view.h"

namespace theatron::or_screen {

enum class Sight {
    visible,
    unmeasured,  // in the picture, but the depth picture does not tell whether something is before
                 // it
    hidden,      // a measured surface is before it
    outside,     // of the picture, or behind the camera
};
const char* text_of(Sight sight);

struct PicturePlace {
    Sight sight = Sight::outside;
    Vec2 pixel;  // of the colour picture, unless outside; as in geometry/camera_model.h
    bool operator==(const PicturePlace&) const = default;
};

// A place that is this much behind a surface is hidden by it: more than the noise of a depth
// measurement and the error of a registration.
inline constexpr double hidden_behind_m = 0.03;

// `depth` is the camera's newest depth picture; without pixels everything is unmeasured. The line
// from the colour lens to the place is followed through that picture in steps of at most a pixel:
// it must not pass through a measured surface. A jump between two surfaces is none, so that a line
// that passes beside an object is not hidden by it.
PicturePlace place_in_picture(const Calibration& calibration, DepthView depth, Vec3 place);

}  // namespace theatron::or_screen
