// SPDX-License-Identifier: Apache-2.0
#include "render/color_visibility.h"

#include "render/cloud_passes.h"

namespace theatron::render {

ColorVisibility::ColorVisibility()
    : program_(make_cloud_program({"cloud.glsl", "color_depth.vert"}, {"depth_only.frag"})),
      camera_(program_.uniform("camera")),
      blocks_per_row_(program_.uniform("blocks_per_row")),
      map_size_(program_.uniform("map_size")) {}

void ColorVisibility::update(const CloudTextures& textures) {
    // Half the depth's size: shadows need not be sharper than what throws them.
    const Size size{(textures.depth_size().width + 1) / 2, (textures.depth_size().height + 1) / 2};
    glActiveTexture(GL_TEXTURE0 + texture_unit);
    if (!maps_ || size != size_ || textures.layers() != layers_) {
        size_ = size;
        layers_ = textures.layers();
        drawn_ = {};
        maps_ = make_texture_array(GL_DEPTH_COMPONENT24, size, layers_, GL_NEAREST);
    }
    int camera = 0;
    for (const auto& [id, source] : textures.sources()) {
        unsigned& drawn = drawn_[std::size_t(source.layer)];
        if (drawn != source.revision && may_be_hidden(source.calibration)) {
            draw_map(textures, source, camera);
            drawn = source.revision;
        }
        ++camera;
    }
    glBindTexture(GL_TEXTURE_2D_ARRAY, maps_->name());
    glActiveTexture(GL_TEXTURE0);
}

void ColorVisibility::draw_map(const CloudTextures& textures, const CloudSource& source,
                               int camera) {
    // Nobody may read what is being drawn.
    glBindTexture(GL_TEXTURE_2D_ARRAY, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, maps_->name(), 0, source.layer);
    const GLenum none = GL_NONE;
    glDrawBuffers(1, &none);
    glReadBuffer(GL_NONE);
    glViewport(0, 0, size_.width, size_.height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    const float farthest = 1;
    glClearBufferfv(GL_DEPTH, 0, &farthest);

    // An odd last row or column has no block; its neighbour's reaches over it.
    const Size depth = textures.depth_size();
    const int blocks_per_row = depth.width / 2;
    program_.use();
    glUniform1i(camera_, camera);
    glUniform1i(blocks_per_row_, blocks_per_row);
    glUniform2f(map_size_, float(size_.width), float(size_.height));
    glDrawArrays(GL_POINTS, 0, blocks_per_row * (depth.height / 2));
}

bool may_be_hidden(const Calibration& calibration) {
    return length(calibration.color_from_depth.translation) > 1e-4;
}

}  // namespace theatron::render
