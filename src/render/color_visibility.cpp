// SPDX-License-Identifier: Apache-2.0
#include "render/color_visibility.h"

#include "render/cloud_passes.h"
#include "render/texture_units.h"

namespace theatron::render {

ColorVisibility::ColorVisibility()
    : program_(make_cloud_program({"cloud.glsl", "color_depth.vert"}, {"depth_only.frag"})),
      blocks_per_row_(program_.uniform("blocks_per_row")),
      map_size_(program_.uniform("map_size")) {}

void ColorVisibility::update(CloudCamera& camera) {
    VisibilityMap& map = camera.visibility;
    if (map.content == camera.content())
        return;
    map.content = camera.content();
    const bool needed = may_be_hidden(camera.calibration());
    // Half the depth's size: shadows need not be sharper than that. Shaders that may
    // read a map want one, even where they do not.
    const Size depth = camera.depth_size();
    const Size size = needed ? Size{(depth.width + 1) / 2, (depth.height + 1) / 2} : Size{1, 1};
    glActiveTexture(GL_TEXTURE0 + texture_unit::nearest_in_color);
    if (!map.nearest || map.size != size) {
        map.nearest = make_texture(GL_DEPTH_COMPONENT24, size, GL_NEAREST);
        map.size = size;
    }
    if (needed) {
        glBindTexture(GL_TEXTURE_2D, 0);  // a texture that is drawn into must not be read
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D,
                               map.nearest->name(), 0);
        const GLenum none = GL_NONE;
        glDrawBuffers(1, &none);
        glReadBuffer(GL_NONE);
        glViewport(0, 0, size.width, size.height);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glDepthMask(GL_TRUE);
        const float farthest = 1;
        glClearBufferfv(GL_DEPTH, 0, &farthest);

        // An odd last row or column has no block; its neighbour's reaches over it.
        const int blocks_per_row = depth.width / 2;
        program_.use();
        glUniform1i(blocks_per_row_, blocks_per_row);
        glUniform2f(map_size_, float(size.width), float(size.height));
        glDrawArrays(GL_POINTS, 0, blocks_per_row * (depth.height / 2));
    }
    bind_texture(texture_unit::nearest_in_color, &*map.nearest);
}

bool may_be_hidden(const Calibration& calibration) {
    return length(calibration.color_from_depth.translation) > 1e-4;
}

}  // namespace theatron::render
