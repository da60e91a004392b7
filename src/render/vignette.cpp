// SPDX-License-Identifier: Apache-2.0
#include "render/vignette.h"

#include <cmath>

#include "render/gl.h"

namespace theatron::render {

struct Vignette::Parts {
    Program program{{"full_picture.vert"}, {"vignette.frag"}};
    GLint tangents = program.uniform("tangents");
    GLint picture = program.uniform("picture");
    GLint ring = program.uniform("ring");
    VertexArray no_attributes;
};

Vignette::Vignette() : parts_(std::make_unique<Parts>()) {}
Vignette::~Vignette() = default;

void Vignette::draw(const CameraView& view, const DrawTarget& target, double strength) {
    if (strength <= 0)
        return;
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    glViewport(target.x, target.y, target.size.width, target.size.height);
    parts_->program.use();
    glUniform4f(parts_->tangents, float(view.left), float(view.top), float(view.right),
                float(view.bottom));
    glUniform4f(parts_->picture, float(target.x), float(target.y), float(target.size.width),
                float(target.size.height));
    glUniform3f(parts_->ring, float(std::tan(radians_of(clear_degrees))),
                float(std::tan(radians_of(dark_degrees))), float(strength));
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glBindVertexArray(parts_->no_attributes.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
}

}  // namespace theatron::render
