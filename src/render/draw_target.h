// SPDX-License-Identifier: Apache-2.0
// The target of a drawn picture.
#pragma once

#include "image/view.h"

namespace theatron::render {

// A part of a framebuffer: the one with this GL name (0 is the window's), and in
// it the rectangle whose lower left corner is (x, y).
struct DrawTarget {
    unsigned framebuffer = 0;
    int x = 0, y = 0;
    Size size;
};

}  // namespace theatron::render
