// SPDX-License-Identifier: Apache-2.0
#include "render/steady_colors.h"

#include "render/cloud_passes.h"
#include "render/texture_units.h"

namespace theatron::render {

SteadyColors::SteadyColors()
    : program_(make_cloud_program({"full_picture.vert"}, {"cloud.glsl", "steady_color.frag"})),
      has_before_(program_.uniform("has_before")) {
    program_.set_sampler("colors_before", texture_unit::steady_before);
}

void SteadyColors::update(CloudCamera& camera) {
    SteadyColor& steady = camera.steady;
    const Size size = camera.color_size();
    if (size == Size{} || steady.colors == camera.colors())
        return;
    steady.colors = camera.colors();
    const bool has_before = steady.size == size;
    glActiveTexture(GL_TEXTURE0 + texture_unit::steady_color);
    if (!has_before)
        // With 8 bits small steps towards a new colour would be rounded away.
        for (auto& picture : steady.pictures)
            picture = make_texture(GL_RGB10_A2, size, GL_LINEAR);
    steady.size = size;
    const Texture& before = *steady.pictures[steady.newest];
    const Texture& after = *steady.pictures[1 - steady.newest];
    steady.newest = 1 - steady.newest;
    bind_texture(texture_unit::steady_color, nullptr);  // a target must not be bound for reading
    bind_texture(texture_unit::steady_before, &before);
    glDisable(GL_DEPTH_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, after.name(), 0);
    glViewport(0, 0, size.width, size.height);
    program_.use();
    glUniform1i(has_before_, has_before);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    bind_texture(texture_unit::steady_before, nullptr);
}

void SteadyColors::bind(const CloudCamera& camera) const {
    const auto& picture = camera.steady.pictures[camera.steady.newest];
    bind_texture(texture_unit::steady_color, picture ? &*picture : nullptr);
}

}  // namespace theatron::render
