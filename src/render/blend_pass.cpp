// SPDX-License-Identifier: Apache-2.0
// Many cameras as one surface: each camera's mesh goes into a layer of its own, and a
// last pass averages the layers where they show the same surface. After the idea of
// BlendPCR (Mühlenbrock, Weller, Zachmann 2024): blend in screen space, by quality and by
// closeness to an edge, instead of building a common mesh.
#include <optional>
#include <string>
#include <vector>

#include "render/cloud_passes.h"
#include "render/color_visibility.h"
#include "render/steady_colors.h"

namespace theatron::render {
namespace {

constexpr int layer_colors_unit = 5, layer_depths_unit = 6;

// For a number of layers.
struct BlendProgram {
    std::string definition;  // read by the compiler alone, but must live as long as its call
    Program program;
    GLint depth_from_w = program.uniform("depth_from_w");
    GLint picture_corner = program.uniform("picture_corner");
    GLint presence = program.uniform("presence");

    explicit BlendProgram(int layers)
        : definition("#define LAYERS " + std::to_string(layers)),
          program(make_cloud_program({"full_picture.vert"},
                                     {"output.glsl", definition, "blend.frag"})) {
        program.set_sampler("layer_colors", layer_colors_unit);
        program.set_sampler("layer_depths", layer_depths_unit);
    }
};

class BlendPass final : public CloudPass {
public:
    BlendPass()
        : layer_program_(make_cloud_program(
              {"cloud.glsl", "surface_read.glsl", "alignment.glsl", "shown.glsl", "set_back.glsl",
               "mesh.vert"},
              {"cloud.glsl", "color.glsl", "torn.glsl", "fade.glsl", "blend_layer.frag"})),
          columns_(layer_program_.uniform("columns")),
          first_camera_(layer_program_.uniform("first_camera")) {
        layer_program_.set_sampler("color_images", SteadyColors::texture_unit);
    }

    void prepare(const CloudFrame& frame) override {
        colors_seen_.update(frame.textures);
        surfaces_.update(frame.textures);
    }

    void draw(const CloudFrame& frame) override {
        make_layers(frame.target.size, int(frame.textures.sources().size()));
        draw_layers(frame);
        blend(frame);
    }

private:
    void make_layers(Size size, int count) {
        if (colors_ && size == size_ && count == count_)
            return;
        size_ = size;
        if (count != count_)
            blend_program_.emplace(count);
        count_ = count;
        glActiveTexture(GL_TEXTURE0 + layer_colors_unit);  // the others are in use
        colors_ = make_texture_array(GL_RGBA8, size, count, GL_NEAREST);
        depths_ = make_texture_array(GL_DEPTH_COMPONENT24, size, count, GL_NEAREST);
    }

    void draw_layers(const CloudFrame& frame) {
        // Nobody may read what is being drawn.
        bind_layers(0, 0);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
        glViewport(0, 0, size_.width, size_.height);
        glEnable(GL_DEPTH_TEST);
        layer_program_.use();
        glUniform1i(columns_, frame.textures.depth_size().width);
        int layer = 0;
        for (const auto& [id, source] : frame.textures.sources()) {
            colors_seen_.bind(source);
            glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, colors_->name(), 0,
                                      layer);
            glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depths_->name(), 0,
                                      layer);
            const float nothing[] = {0, 0, 0, 0}, farthest = 1;
            glClearBufferfv(GL_COLOR, 0, nothing);
            glClearBufferfv(GL_DEPTH, 0, &farthest);
            glUniform1i(first_camera_, layer++);
            frame.grid.draw(frame.textures.depth_size(), 1);
        }
    }

    void blend(const CloudFrame& frame) {
        std::vector<float> presence;
        bool all_present = true;
        for (const auto& [id, source] : frame.textures.sources()) {
            presence.push_back(float(source.presence));
            all_present = all_present && source.presence == 1;
        }
        const DrawTarget& target = frame.target;
        glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
        glViewport(target.x, target.y, target.size.width, target.size.height);
        bind_layers(colors_->name(), depths_->name());
        const BlendProgram& p = *blend_program_;
        p.program.use();
        set_depth_from_w(frame.view, p.depth_from_w);
        glUniform2i(p.picture_corner, target.x, target.y);
        glUniform1fv(p.presence, GLsizei(presence.size()), presence.data());
        if (!all_present) {
            glEnable(GL_BLEND);
            glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE,
                                GL_ONE_MINUS_SRC_ALPHA);
        }
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glDisable(GL_BLEND);
    }

    static void bind_layers(GLuint colors, GLuint depths) {
        glActiveTexture(GL_TEXTURE0 + layer_colors_unit);
        glBindTexture(GL_TEXTURE_2D_ARRAY, colors);
        glActiveTexture(GL_TEXTURE0 + layer_depths_unit);
        glBindTexture(GL_TEXTURE_2D_ARRAY, depths);
        glActiveTexture(GL_TEXTURE0);
    }

    Program layer_program_;
    std::optional<BlendProgram> blend_program_;
    GLint columns_, first_camera_;
    SteadyColors colors_seen_;
    SurfaceMaps surfaces_{SurfaceMaps::Kind::refined};
    Framebuffer framebuffer_;
    std::optional<Texture> colors_, depths_;
    Size size_;
    int count_ = 0;
};

}  // namespace

std::unique_ptr<CloudPass> make_blend_pass() {
    return std::make_unique<BlendPass>();
}

}  // namespace theatron::render
