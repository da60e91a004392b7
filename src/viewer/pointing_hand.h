// SPDX-License-Identifier: Apache-2.0
// The ray of a person who points with the mouse or a finger. The others find the place by this ray,
// which begins at a hand and not at the eye; so the ray has to meet first what the person points
// at.
//
// Pure functions; room coordinates, metres.
#pragma once

#include <functional>
#include <optional>

#include "render/camera_view.h"
#include "render/pick.h"

namespace theatron::viewer {

// The place that a ray meets first, as each participant finds it; nullopt: it meets nothing.
using MetPlace = std::function<std::optional<Vec3>(const render::PickRay& ray)>;

// The ray of the person's view through a place of the picture, in shares from its upper left
// corner.
using RayThrough = std::function<render::PickRay(Vec2 place)>;

// The place below the pointer. A measured surface has gaps of a few pixels that the picture closes:
// a ray through one of them takes the middle of the places that rays around it meet on the nearest
// surface, up to 1 % of the picture's height away. `aspect`: its width over its height. Nullopt
// where there is none.
std::optional<Vec3> pointed_place(const RayThrough& ray_through, double aspect, Vec2 pointer,
                                  const MetPlace& met);

// The ray of the hand to pointed_place(), or along the eye's ray where that is nothing. The hand is
// below the eye and to its right, so that its owner sees the ray from the side. If something else
// is before the place, the hand is nearer to the eye, and at last as ray_along().
render::PickRay pointing_ray(const render::CameraView& view, Vec2 pointer, const MetPlace& met);

// A ray to `place` on the line from the eye, whose dots do not cover the place.
render::PickRay ray_along(Vec3 eye, Vec3 place);

// A hand at the ray's beginning that points along it: y up, -z forward.
Pose hand_on(const render::PickRay& ray);

}  // namespace theatron::viewer
