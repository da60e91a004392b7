// SPDX-License-Identifier: Apache-2.0
#include "render/steady_colors.h"

#include "render/cloud_passes.h"

namespace theatron::render {

SteadyColors::SteadyColors()
    : program_(make_cloud_program({"full_picture.vert"}, {"cloud.glsl", "steady_color.frag"})),
      layer_(program_.uniform("layer")),
      has_before_(program_.uniform("has_before")) {
    program_.set_sampler("colors_before", before_unit);
}

void SteadyColors::make_pictures(const CloudTextures& textures) {
    if (pictures_[0] && textures.color_size() == size_ && textures.layers() == layers_)
        return;
    size_ = textures.color_size();
    layers_ = textures.layers();
    drawn_ = {};
    glActiveTexture(GL_TEXTURE0 + texture_unit);
    // With 8 bits small steps towards a new colour would be rounded away.
    for (auto& pictures : pictures_)
        pictures = make_texture_array(GL_RGB10_A2, size_, layers_, GL_LINEAR);
}

void SteadyColors::update(const CloudTextures& textures) {
    if (textures.color_size() == Size{})
        return;
    make_pictures(textures);
    glDisable(GL_DEPTH_TEST);
    for (const auto& [id, source] : textures.sources())
        if (drawn_[std::size_t(source.layer)].revision != source.revision)
            draw(source);
}

void SteadyColors::draw(const CloudSource& source) {
    State& state = drawn_[std::size_t(source.layer)];
    const bool has_before = state.revision != 0 && state.size == source.color_size;
    const Texture &before = *pictures_[state.newest], &after = *pictures_[1 - state.newest];
    state = {source.revision, source.color_size, 1 - state.newest};
    if (source.color_size == Size{})
        return;
    glActiveTexture(GL_TEXTURE0 + texture_unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, 0);  // nobody may read what is being drawn
    glActiveTexture(GL_TEXTURE0 + before_unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, before.name());
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, after.name(), 0, source.layer);
    glViewport(0, 0, source.color_size.width, source.color_size.height);
    program_.use();
    glUniform1i(layer_, source.layer);
    glUniform1i(has_before_, has_before);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindTexture(GL_TEXTURE_2D_ARRAY, 0);
    glActiveTexture(GL_TEXTURE0);
}

void SteadyColors::bind(const CloudSource& source) const {
    const auto& pictures = pictures_[drawn_[std::size_t(source.layer)].newest];
    glActiveTexture(GL_TEXTURE0 + texture_unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, pictures ? pictures->name() : 0);
    glActiveTexture(GL_TEXTURE0);
}

}  // namespace theatron::render
