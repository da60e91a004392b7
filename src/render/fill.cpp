// SPDX-License-Identifier: Apache-2.0
#include "render/fill.h"

#include "render/gl.h"

namespace theatron::render {

void fill(const DrawTarget& target, Rgb color) {
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    glEnable(GL_SCISSOR_TEST);
    glScissor(target.x, target.y, target.size.width, target.size.height);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(float(color.r) / 255, float(color.g) / 255, float(color.b) / 255, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace theatron::render
