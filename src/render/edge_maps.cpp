// SPDX-License-Identifier: Apache-2.0
#include "render/edge_maps.h"

#include "render/cloud_passes.h"
#include "render/texture_units.h"

namespace theatron::render {

EdgeMaps::EdgeMaps()
    : find_edges_(make_cloud_program(
          {"full_picture.vert"}, {"cloud.glsl", "refined.glsl", "neighbours.glsl", "edges.frag"})),
      spread_(make_cloud_program({"full_picture.vert"}, {"edge_distance.frag"})),
      has_before_(spread_.uniform("has_before")) {
    spread_.set_sampler("whole", texture_unit::edges_whole);
    spread_.set_sampler("distances_before", texture_unit::edges_before);
}

void EdgeMaps::draw(EdgeMap& map, Size depth, bool has_before) {
    const Size size{(depth.width + 3) / 4, (depth.height + 3) / 4};
    if (!map.whole) {
        glActiveTexture(GL_TEXTURE0 + texture_unit::edges_whole);
        map.whole = make_texture(GL_R8, size, GL_NEAREST);
        for (auto& distances : map.distances)
            distances = make_texture(GL_R8, size, GL_LINEAR);
    }
    const Texture &before = *map.distances[map.newest], &after = *map.distances[1 - map.newest];
    map.newest = 1 - map.newest;
    glViewport(0, 0, size.width, size.height);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    // A texture that is drawn into must not be read.
    bind_texture(texture_unit::edge_distances, nullptr);
    bind_texture(texture_unit::edges_whole, nullptr);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, map.whole->name(),
                           0);
    find_edges_.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);

    bind_texture(texture_unit::edges_whole, &*map.whole);
    bind_texture(texture_unit::edges_before, &before);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, after.name(), 0);
    spread_.use();
    glUniform1i(has_before_, has_before);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    bind_texture(texture_unit::edges_before, nullptr);
    bind_texture(texture_unit::edge_distances, &after);
}

}  // namespace theatron::render
