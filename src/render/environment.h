// SPDX-License-Identifier: Apache-2.0
// The light from all around: a computed bright room with lamps in its ceiling, as a cube map. Its
// smaller levels are blurred for rougher surfaces; the last one is for diffuse light.
#pragma once

#include "render/gl.h"

namespace theatron::render {

inline constexpr int environment_side = 32, environment_levels = 5;

// Makes the cube map and leaves it bound to the active texture unit. Takes some milliseconds.
Texture make_environment();

}  // namespace theatron::render
