// SPDX-License-Identifier: Apache-2.0
// The shape of the patient under the cover, shared by the cover and the situs.
#pragma once

#include "synthetic/vec3f.h"

namespace theatron::synthetic {

// The opening of the belly: an oval around the room's origin.
inline constexpr float window_x = 0.175f, window_z = 0.13f;  // half axes of the cover's window

// Position relative to the oval: 1 on its border, less inside.
inline float window_distance(float x, float z) {
    // Between an ellipse and a rectangle.
    const float u = std::abs(x) / window_x, v = std::abs(z) / window_z;
    return std::pow(u * u * u + v * v * v, 1.0f / 3);
}

// Height of the body's upper surface, without cover.
float body_height(float x, float z);

// Rise of a place at full inspiration, relative, 0 to 1.
inline float breath_lift(F3 p) {
    return smoothstep(0.44f, 0.06f, std::abs(p.x + 0.02f)) *
           smoothstep(0.42f, 0.12f, std::abs(p.z)) * smoothstep(0.9f, 1.04f, p.y);
}

}  // namespace theatron::synthetic
