// SPDX-License-Identifier: Apache-2.0
#include "render/cloud_passes.h"

#include "render/matrix.h"
#include "render/surface_maps.h"
#include "render/texture_units.h"

namespace theatron::render {
namespace {

// Draws a point for every depth pixel.
class PointPass final : public CloudPass {
public:
    explicit PointPass(Program program) : program_(std::move(program)) {}

    void draw(const CloudFrame& frame) override {
        const Size picture = frame.target.size;
        program_.use();
        glUniform2f(half_picture_, float(picture.width / 2.0), float(picture.height / 2.0));
        glUniform1f(pixels_per_tan_, float(picture.width / (frame.view.right - frame.view.left)));
        glUniform1f(point_size_, float(frame.point_size));
        set_depth_from_w(frame.view, depth_from_w_);
        // Points near the border reach beyond the viewport of their middles.
        glEnable(GL_SCISSOR_TEST);
        glScissor(frame.target.x, frame.target.y, picture.width, picture.height);
        for (const CloudCamera* camera : frame.cameras) {
            camera->bind();
            glUniform1i(columns_, camera->depth_size().width);
            glDrawArrays(GL_POINTS, 0, GLsizei(camera->depth_size().area()));
        }
        glDisable(GL_SCISSOR_TEST);
    }

private:
    Program program_;
    GLint columns_ = program_.uniform("columns");
    GLint half_picture_ = program_.uniform("half_picture");
    GLint point_size_ = program_.uniform("point_size");
    GLint pixels_per_tan_ = program_.uniform("pixels_per_tan");
    GLint depth_from_w_ = program_.uniform("depth_from_w");
};

// Draws every camera's depth image as a grid.
class GridPass final : public CloudPass {
public:
    GridPass(Program program, bool reads_surfaces) : program_(std::move(program)) {
        if (reads_surfaces)
            surfaces_.emplace(SurfaceMaps::Kind::measured);
    }

    void prepare(CloudCamera& camera) override {
        if (surfaces_)
            surfaces_->update(camera);
    }

    void draw(const CloudFrame& frame) override {
        program_.use();
        glUniform1i(sets_back_, 1);
        set_depth_from_w(frame.view, depth_from_w_);
        for (const CloudCamera* camera : frame.cameras) {
            camera->bind();
            if (surfaces_)
                surfaces_->bind(*camera);
            glUniform1i(columns_, camera->depth_size().width);
            camera->grid().draw();
        }
    }

private:
    Program program_;
    GLint columns_ = program_.uniform("columns");
    GLint sets_back_ = program_.uniform("sets_back");
    GLint depth_from_w_ = program_.uniform("depth_from_w");
    std::optional<SurfaceMaps> surfaces_;
};

}  // namespace

std::unique_ptr<CloudPass> make_splat_pass() {
    return std::make_unique<PointPass>(
        make_cloud_program({"cloud.glsl", "color_place.glsl", "measured.glsl", "neighbours.glsl",
                            "splat_steps.glsl", "shown.glsl", "set_back.glsl", "splat.vert"},
                           {"cloud.glsl", "color.glsl", "output.glsl", "fade.glsl", "splat.frag"}));
}

std::unique_ptr<CloudPass> make_disc_pass() {
    return std::make_unique<PointPass>(
        make_cloud_program({"cloud.glsl", "color_place.glsl", "measured.glsl", "neighbours.glsl",
                            "splat_steps.glsl", "shown.glsl", "set_back.glsl", "disc.vert"},
                           {"cloud.glsl", "color.glsl", "output.glsl", "fade.glsl", "disc.frag"}));
}

std::unique_ptr<CloudPass> make_mesh_pass() {
    return std::make_unique<GridPass>(
        make_cloud_program(
            {"cloud.glsl", "surface_read.glsl", "alignment.glsl", "shown.glsl", "set_back.glsl",
             "mesh.vert"},
            {"cloud.glsl", "color.glsl", "output.glsl", "torn.glsl", "fade.glsl", "mesh.frag"}),
        true);
}

std::unique_ptr<CloudPass> make_bare_grid_pass() {
    return std::make_unique<GridPass>(
        make_cloud_program({"cloud.glsl", "bare_grid.vert"},
                           {"cloud.glsl", "color.glsl", "output.glsl", "bare_grid.frag"}),
        false);
}

Program make_cloud_program(ShaderFiles vertex, ShaderFiles fragment) {
    Program program(vertex, fragment);
    program.set_sampler("depth_image", texture_unit::depth_image);
    program.set_sampler("rays", texture_unit::rays);
    program.set_sampler("color_picture", texture_unit::color_picture);
    program.set_sampler("nearest_in_color", texture_unit::nearest_in_color);
    program.set_sampler("edge_distances", texture_unit::edge_distances);
    program.set_sampler("refined_depth", texture_unit::refined_depth);
    program.set_sampler("surfaces", texture_unit::surfaces);
    program.bind_block("Camera", camera_block_binding);
    return program;
}

}  // namespace theatron::render
