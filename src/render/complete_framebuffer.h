// SPDX-License-Identifier: Apache-2.0
// Asks the driver if it can draw into a framebuffer.
#pragma once

#include "render/gl.h"

namespace theatron::render {

// True if the bound framebuffer can be drawn into. `Kind` stands for the formats of its
// attachments: a browser answers only when all is drawn that was begun, so there only the first
// framebuffer of each kind is asked for.
template <class Kind>
bool is_complete_framebuffer() {
#ifdef __EMSCRIPTEN__
    static bool is_possible = false;
    if (!is_possible)
        is_possible = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    return is_possible;
#else
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
#endif
}

}  // namespace theatron::render
