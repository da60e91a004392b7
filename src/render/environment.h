// SPDX-License-Identifier: Apache-2.0
// The light that comes from all around: a bright room with lamps in its ceiling, computed, as a
// cube map whose smaller levels are blurred for rougher surfaces; the last is for diffuse light.
#pragma once

#include "render/gl.h"

namespace theatron::render {

inline constexpr int environment_side = 32, environment_levels = 5;

// Left bound to the active texture unit. Takes some milliseconds.
Texture make_environment();

}  // namespace theatron::render
