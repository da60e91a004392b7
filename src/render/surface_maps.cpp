// SPDX-License-Identifier: Apache-2.0
#include "render/surface_maps.h"

#include "render/cloud_passes.h"
#include "render/texture_units.h"

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

SurfaceMaps::SurfaceMaps(Kind kind) : kind_(kind), find_surface_(surface_program(kind)) {
    if (kind == Kind::measured)
        return;
    refine_ = make_cloud_program(
        {"full_picture.vert"}, {"cloud.glsl", "corrected.glsl", "neighbours.glsl", "refine.frag"});
    refine_->set_sampler("refined_before", texture_unit::refined_before);
    has_before_ = refine_->uniform("has_before");
    edges_.emplace();
}

void SurfaceMaps::update(CloudCamera& camera) {
    SurfaceMap& map = camera.surfaces[int(kind_)];
    if (map.content == camera.content())
        return;
    map.content = camera.content();
    const Size size = camera.depth_size();
    glActiveTexture(GL_TEXTURE0 + texture_unit::surfaces);
    if (!map.map)
        map.map = make_texture(GL_RGBA32UI, size, GL_NEAREST);
    glDisable(GL_DEPTH_TEST);
    // Another colour lens changes the map, but is no frame for the filters over time.
    if (kind_ == Kind::refined) {
        if (map.images != camera.images() || !map.refined[0])
            refine(map, size);
        map.images = camera.images();
        bind_texture(texture_unit::refined_depth, &*map.refined[map.newest]);
        bind_texture(texture_unit::edge_distances, &*map.edges.distances[map.edges.newest]);
    }
    bind_texture(texture_unit::surfaces, nullptr);  // a target must not be bound for reading
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, map.map->name(), 0);
    glViewport(0, 0, size.width, size.height);
    find_surface_.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void SurfaceMaps::refine(SurfaceMap& map, Size size) {
    const bool has_before = map.refined[0].has_value();
    glActiveTexture(GL_TEXTURE0 + texture_unit::refined_before);
    if (!has_before)
        for (auto& refined : map.refined)
            refined = make_texture(GL_R32UI, size, GL_NEAREST);
    const Texture &before = *map.refined[map.newest], &after = *map.refined[1 - map.newest];
    map.newest = 1 - map.newest;
    bind_texture(texture_unit::refined_before, &before);
    bind_texture(texture_unit::refined_depth, nullptr);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, after.name(), 0);
    glViewport(0, 0, size.width, size.height);
    refine_->use();
    glUniform1i(has_before_, has_before);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    bind_texture(texture_unit::refined_before, nullptr);
    bind_texture(texture_unit::refined_depth, &after);
    edges_->draw(map.edges, size, has_before);
}

void SurfaceMaps::bind(const CloudCamera& camera) const {
    bind_texture(texture_unit::surfaces, &*camera.surfaces[int(kind_)].map);
}

}  // namespace theatron::render
