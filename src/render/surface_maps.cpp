// SPDX-License-Identifier: Apache-2.0
#include "render/surface_maps.h"

#include "render/cloud_passes.h"

namespace theatron::render {
namespace {

Program surface_program(SurfaceMaps::Kind kind) {
    if (kind == SurfaceMaps::Kind::measured)
        return make_cloud_program({"full_picture.vert"},
                                  {"cloud.glsl", "color_place.glsl", "measured.glsl",
                                   "neighbours.glsl", "quality_none.glsl", "surface.frag"});
    return make_cloud_program({"full_picture.vert"},
                              {"cloud.glsl", "color_place.glsl", "refined.glsl", "neighbours.glsl",
                               "quality.glsl", "surface.frag"});
}

}  // namespace

SurfaceMaps::SurfaceMaps(Kind kind)
    : kind_(kind), find_surface_(surface_program(kind)), camera_(find_surface_.uniform("camera")) {
    if (kind == Kind::measured)
        return;
    refine_ = make_cloud_program(
        {"full_picture.vert"}, {"cloud.glsl", "corrected.glsl", "neighbours.glsl", "refine.frag"});
    refine_->set_sampler("refined_before", refined_before_unit);
    edges_.emplace();
}

void SurfaceMaps::make_maps(const CloudTextures& textures) {
    if (maps_ && textures.depth_size() == size_ && textures.layers() == layers_)
        return;
    size_ = textures.depth_size();
    layers_ = textures.layers();
    drawn_ = {};
    glActiveTexture(GL_TEXTURE0 + texture_unit);
    maps_ = make_texture_array(GL_RGBA32UI, size_, layers_, GL_NEAREST);
    if (kind_ == Kind::refined) {
        glActiveTexture(GL_TEXTURE0 + refined_unit);
        for (auto& refined : refined_)
            refined = make_texture_array(GL_R32UI, size_, layers_, GL_NEAREST);
    }
}

void SurfaceMaps::update(const CloudTextures& textures) {
    make_maps(textures);
    glDisable(GL_DEPTH_TEST);
    int camera = 0;
    for (const auto& [id, source] : textures.sources()) {
        unsigned& drawn = drawn_[std::size_t(source.layer)];
        if (drawn != source.revision) {
            if (kind_ == Kind::refined)
                refine(camera, source.layer, drawn != 0);
            glActiveTexture(GL_TEXTURE0 + texture_unit);
            glBindTexture(GL_TEXTURE_2D_ARRAY, 0);  // nobody may read what is being drawn
            glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
            glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, maps_->name(), 0,
                                      source.layer);
            glViewport(0, 0, size_.width, size_.height);
            find_surface_.use();
            glUniform1i(camera_, camera);
            glDrawArrays(GL_TRIANGLES, 0, 3);
            drawn = source.revision;
        }
        ++camera;
    }
    glActiveTexture(GL_TEXTURE0 + texture_unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, maps_->name());
    glActiveTexture(GL_TEXTURE0);
}

// Leaves refined depth and the distances to edges bound.
void SurfaceMaps::refine(int camera, int layer, bool has_before) {
    unsigned& newest = newest_[std::size_t(layer)];
    const Texture &before = *refined_[newest], &after = *refined_[1 - newest];
    newest = 1 - newest;
    glActiveTexture(GL_TEXTURE0 + refined_before_unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, before.name());
    glActiveTexture(GL_TEXTURE0 + refined_unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, after.name(), 0, layer);
    glViewport(0, 0, size_.width, size_.height);
    refine_->use();
    glUniform1i(refine_->uniform("camera"), camera);
    glUniform1i(refine_->uniform("has_before"), has_before);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glActiveTexture(GL_TEXTURE0 + refined_before_unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, 0);
    glActiveTexture(GL_TEXTURE0 + refined_unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, after.name());
    edges_->draw(camera, layer, size_, layers_, has_before);
}

}  // namespace theatron::render
