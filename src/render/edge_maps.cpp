// SPDX-License-Identifier: Apache-2.0
#include "render/edge_maps.h"

#include "render/cloud_passes.h"

namespace theatron::render {
namespace {

constexpr int whole_unit = 5, before_unit = 6;

}  // namespace

EdgeMaps::EdgeMaps()
    : find_edges_(make_cloud_program(
          {"full_picture.vert"}, {"cloud.glsl", "refined.glsl", "neighbours.glsl", "edges.frag"})),
      spread_(make_cloud_program({"full_picture.vert"}, {"edge_distance.frag"})),
      camera_(find_edges_.uniform("camera")),
      layer_(spread_.uniform("layer")),
      has_before_(spread_.uniform("has_before")) {
    spread_.set_sampler("whole", whole_unit);
    spread_.set_sampler("distances_before", before_unit);
}

void EdgeMaps::draw(int camera, int layer, Size depth, int layers, bool has_before) {
    const Size size{(depth.width + 3) / 4, (depth.height + 3) / 4};
    if (!whole_ || size != size_ || layers != layers_) {
        size_ = size;
        layers_ = layers;
        whole_.emplace();
        glActiveTexture(GL_TEXTURE0 + whole_unit);
        glBindTexture(GL_TEXTURE_2D, whole_->name());
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_R8, size.width, size.height);
        set_sampling(GL_TEXTURE_2D, GL_NEAREST);
        glActiveTexture(GL_TEXTURE0 + texture_unit);
        for (auto& distances : distances_)
            distances = make_texture_array(GL_R8, size, layers_, GL_LINEAR);
        has_before = false;
    }
    unsigned& newest = newest_[std::size_t(layer)];
    const Texture &before = *distances_[newest], &after = *distances_[1 - newest];
    newest = 1 - newest;
    glViewport(0, 0, size_.width, size_.height);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    // Nobody may read what is being drawn.
    glActiveTexture(GL_TEXTURE0 + texture_unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, 0);
    glActiveTexture(GL_TEXTURE0 + whole_unit);
    glBindTexture(GL_TEXTURE_2D, 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, whole_->name(), 0);
    find_edges_.use();
    glUniform1i(camera_, camera);
    glDrawArrays(GL_TRIANGLES, 0, 3);

    glBindTexture(GL_TEXTURE_2D, whole_->name());
    glActiveTexture(GL_TEXTURE0 + before_unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, before.name());
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, after.name(), 0, layer);
    spread_.use();
    glUniform1i(layer_, layer);
    glUniform1i(has_before_, has_before);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindTexture(GL_TEXTURE_2D_ARRAY, 0);
    glActiveTexture(GL_TEXTURE0 + whole_unit);
    glBindTexture(GL_TEXTURE_2D, 0);
    glActiveTexture(GL_TEXTURE0 + texture_unit);
    glBindTexture(GL_TEXTURE_2D_ARRAY, after.name());
    glActiveTexture(GL_TEXTURE0);
}

}  // namespace theatron::render
