// SPDX-License-Identifier: Apache-2.0
// Many cameras as one surface: each camera's mesh goes into a layer of its own, and a
// last pass averages the layers where they show the same surface. After the idea of
// BlendPCR (Mühlenbrock, Weller, Zachmann 2024): blend in screen space, by quality and by
// closeness to an edge, instead of building a common mesh.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "render/cloud_passes.h"
#include "render/matrix.h"
#include "render/steady_colors.h"
#include "render/surface_maps.h"
#include "render/texture_units.h"

namespace theatron::render {
namespace {

// The program for a number of layers.
struct BlendProgram {
    std::string definition;  // read by the compiler alone, but must live as long as its call
    Program program;
    GLint depth_from_w = program.uniform("depth_from_w");
    GLint picture_corner = program.uniform("picture_corner");
    GLint tan_per_pixel = program.uniform("tan_per_pixel");
    GLint presence = program.uniform("presence");

    explicit BlendProgram(int layers)
        : definition("#define LAYERS " + std::to_string(layers)),
          program(make_cloud_program({"full_picture.vert"},
                                     {"output.glsl", definition, "blend.frag"})) {
        program.set_sampler("layer_colors", texture_unit::layer_colors);
        program.set_sampler("layer_depths", texture_unit::layer_depths);
    }
};

class BlendPass final : public CloudPass {
public:
    BlendPass()
        : layer_program_(make_cloud_program(
              {"cloud.glsl", "surface_read.glsl", "alignment.glsl", "shown.glsl", "set_back.glsl",
               "mesh.vert"},
              {"cloud.glsl", "color.glsl", "torn.glsl", "fade.glsl", "blend_layer.frag"})),
          columns_(layer_program_.uniform("columns")) {
        layer_program_.set_sampler("color_picture", texture_unit::steady_color);
    }

    void prepare(CloudCamera& camera) override {
        colors_.update(camera);
        surfaces_.update(camera);
    }

    void draw(const CloudFrame& frame) override {
        make_layers(frame.layers, frame.target.size, int(frame.cameras.size()));
        draw_layers(frame);
        blend(frame);
    }

private:
    static void make_layers(BlendLayers& layers, Size size, int count) {
        if (layers.colors && layers.size == size && layers.count == count)
            return;
        layers.size = size;
        layers.count = count;
        glActiveTexture(GL_TEXTURE0 + texture_unit::layer_colors);
        layers.colors = make_texture_array(GL_RGBA8, size, count, GL_NEAREST);
        layers.depths = make_texture_array(GL_DEPTH_COMPONENT24, size, count, GL_NEAREST);
    }

    void draw_layers(const CloudFrame& frame) {
        // A texture that is drawn into must not be read.
        bind_layers(0, 0);
        const Size size = frame.target.size;
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
        glViewport(0, 0, size.width, size.height);
        glEnable(GL_DEPTH_TEST);
        layer_program_.use();
        int layer = 0;
        for (const CloudCamera* camera : frame.cameras) {
            camera->bind();
            colors_.bind(*camera);
            surfaces_.bind(*camera);
            glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                      frame.layers.colors->name(), 0, layer);
            glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT,
                                      frame.layers.depths->name(), 0, layer);
            const float nothing[] = {0, 0, 0, 0}, farthest = 1;
            glClearBufferfv(GL_COLOR, 0, nothing);
            glClearBufferfv(GL_DEPTH, 0, &farthest);
            glUniform1i(columns_, camera->depth_size().width);
            camera->grid().draw();
            ++layer;
        }
    }

    void blend(const CloudFrame& frame) {
        std::vector<float> presence;
        bool all_present = true;
        double tan_per_pixel = 0;  // of the coarsest depth image
        for (const CloudCamera* camera : frame.cameras) {
            tan_per_pixel = std::max(tan_per_pixel, camera->tan_per_pixel());
            presence.push_back(float(camera->presence));
            all_present = all_present && camera->presence == 1;
        }
        const DrawTarget& target = frame.target;
        glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
        glViewport(target.x, target.y, target.size.width, target.size.height);
        bind_layers(frame.layers.colors->name(), frame.layers.depths->name());
        const BlendProgram& p =
            blend_programs_.try_emplace(frame.layers.count, frame.layers.count).first->second;
        p.program.use();
        set_depth_from_w(frame.view, p.depth_from_w);
        glUniform2i(p.picture_corner, target.x, target.y);
        glUniform1f(p.tan_per_pixel, float(tan_per_pixel));
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
        glActiveTexture(GL_TEXTURE0 + texture_unit::layer_colors);
        glBindTexture(GL_TEXTURE_2D_ARRAY, colors);
        glActiveTexture(GL_TEXTURE0 + texture_unit::layer_depths);
        glBindTexture(GL_TEXTURE_2D_ARRAY, depths);
        glActiveTexture(GL_TEXTURE0);
    }

    Program layer_program_;
    std::map<int, BlendProgram> blend_programs_;  // by the number of layers
    GLint columns_;
    SteadyColors colors_;
    SurfaceMaps surfaces_{SurfaceMaps::Kind::refined};
    Framebuffer framebuffer_;
};

}  // namespace

std::unique_ptr<CloudPass> make_blend_pass() {
    return std::make_unique<BlendPass>();
}

}  // namespace theatron::render
