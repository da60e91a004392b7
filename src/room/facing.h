// SPDX-License-Identifier: Apache-2.0
// Texts in the room that face the eye.
#pragma once

#include "geometry/vec.h"

namespace theatron::room {

// The frame of a render::SceneText at `place`: upright, and turned to the eye about the vertical.
inline Pose facing(Vec3 place, Vec3 eye) {
    const Vec3 away{place.x - eye.x, 0, place.z - eye.z};
    if (length(away) < 1e-6)
        return {Quat{0, 1, 0, 0}, place};
    return look_at(place, place + away, {0, 1, 0});
}

}  // namespace theatron::room
