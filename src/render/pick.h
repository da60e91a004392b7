// SPDX-License-Identifier: Apache-2.0
// The object that a ray meets first: a pointer's ray, a hand's, or one through a pixel.
//
// Rays are followed on the CPU, because a controller's ray belongs to no picture, and because
// reading one back from the GPU would wait for it.
#pragma once

#include <optional>

#include "render/camera_view.h"
#include "render/scene_frame.h"

namespace theatron::render {

// In room coordinates. The direction need not have unit length.
struct PickRay {
    Vec3 from, direction;
};

struct Picked {
    PickId id = PickId::none;
    double distance_m = 0;
    Vec3 place, normal;  // the normal points to the side that the ray comes from
};

// The nearest object that has an id. Objects without one are transparent for rays. Needs no GL
// context, but the meshes must still exist.
std::optional<Picked> pick(const SceneFrame& frame, const PickRay& ray);

// Through a place of a picture, from (0, 0) at its upper left to (1, 1) at its lower right corner.
PickRay ray_through(const CameraView& view, Vec2 place);

}  // namespace theatron::render
