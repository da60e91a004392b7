// SPDX-License-Identifier: Apache-2.0
// Plain rectangles.
#pragma once

#include "render/draw_target.h"

namespace theatron::render {

// Gives the target one colour. The GL context must be current.
void fill(const DrawTarget& target, Rgb color);

}  // namespace theatron::render
