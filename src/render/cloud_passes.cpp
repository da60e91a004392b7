// SPDX-License-Identifier: Apache-2.0
#include "render/cloud_passes.h"

#include "render/color_visibility.h"
#include "render/matrix.h"

namespace theatron::render {
namespace {

// `Camera` in cloud.glsl, in the layout std140.
struct CameraUniforms {
    float clip_from_camera[16];
    float color_from_camera[16];
    float color_pinhole[4];
    float color_radial[4];
    float color_more[4];
    float color_image[4];
    float depth_image[4];
    float viewer[4];
    float color_gain[4];
    float keep[4];
    float remove_from[4];
    float remove_to[4];
};
static_assert(sizeof(CameraUniforms) == 288);

void put(float (&out)[16], const Mat4& matrix) {
    for (std::size_t i = 0; i < 16; ++i)
        out[i] = float(matrix.m[i]);
}

void put(float (&out)[4], double x, double y, double z, double w) {
    out[0] = float(x);
    out[1] = float(y);
    out[2] = float(z);
    out[3] = float(w);
}

void put_cut(CameraUniforms& u, const CloudCut& cut, const Pose& camera_from_room) {
    if (cut.keep) {
        const Vec3 middle = camera_from_room * cut.keep->middle;
        put(u.keep, middle.x, middle.y, middle.z, cut.keep->radius_m);
    }
    if (cut.remove) {
        const Vec3 from = camera_from_room * cut.remove->from;
        const Vec3 to = camera_from_room * cut.remove->to;
        put(u.remove_from, from.x, from.y, from.z, cut.remove->radius_m);
        put(u.remove_to, to.x, to.y, to.z, 0);
    }
    u.remove_to[3] = float(cut.border_m);
}

CameraUniforms uniforms(const CloudSource& source, const CameraView& view) {
    const Calibration& calibration = source.calibration;
    const Pose eye_from_camera = inverse(view.room_from_eye) * calibration.room_from_camera;
    CameraUniforms u{};
    put(u.clip_from_camera, projection(view) * matrix(eye_from_camera));
    put(u.color_from_camera, matrix(calibration.color_from_depth));
    // Without a colour picture its size stays 0 and everything lies outside.
    if (source.color_size != Size{} && calibration.color.size != Size{}) {
        const CameraModel color = scaled(calibration.color, source.color_size);
        put(u.color_pinhole, color.fx, color.fy, color.cx, color.cy);
        put(u.color_radial, color.k[0], color.k[1], color.k[2], color.k[3]);
        put(u.color_more, color.k[4], color.k[5], color.p1, color.p2);
        put(u.color_image, color.size.width, color.size.height, color.max_radius,
            may_be_hidden(calibration) ? 1 : 0);
    }
    const double tan_per_pixel = 2 / (calibration.depth.fx + calibration.depth.fy);
    put(u.depth_image, calibration.depth_unit_mm / 1000, source.layer, tan_per_pixel,
        source.depth_offset_m);
    const Vec3 viewer = inverse(eye_from_camera).translation;
    put(u.viewer, viewer.x, viewer.y, viewer.z, 0);
    put(u.color_gain, source.color_gain.x, source.color_gain.y, source.color_gain.z,
        source.presence);
    put_cut(u, source.cut, inverse(calibration.room_from_camera));
    return u;
}

// Draws a point for every depth pixel.
class PointPass final : public CloudPass {
public:
    explicit PointPass(Program program) : program_(std::move(program)) {}

    void draw(const CloudFrame& frame) override {
        const Size size = frame.textures.depth_size(), picture = frame.target.size;
        program_.use();
        glUniform1i(columns_, size.width);
        glUniform2f(half_picture_, float(picture.width / 2.0), float(picture.height / 2.0));
        glUniform1f(pixels_per_tan_, float(picture.width / (frame.view.right - frame.view.left)));
        set_depth_from_w(frame.view, depth_from_w_);
        // Points are wider than the viewport that their middles lie in.
        glEnable(GL_SCISSOR_TEST);
        glScissor(frame.target.x, frame.target.y, picture.width, picture.height);
        glDrawArraysInstanced(GL_POINTS, 0, GLsizei(size.area()),
                              GLsizei(frame.textures.sources().size()));
        glDisable(GL_SCISSOR_TEST);
    }

private:
    Program program_;
    GLint columns_ = program_.uniform("columns");
    GLint half_picture_ = program_.uniform("half_picture");
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

    void prepare(const CloudFrame& frame) override {
        if (surfaces_)
            surfaces_->update(frame.textures);
    }

    void draw(const CloudFrame& frame) override {
        program_.use();
        glUniform1i(columns_, frame.textures.depth_size().width);
        glUniform1i(sets_back_, 1);
        set_depth_from_w(frame.view, depth_from_w_);
        frame.grid.draw(frame.textures.depth_size(), int(frame.textures.sources().size()));
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

void CameraBlock::bind(const CloudFrame& frame) const {
    std::vector<CameraUniforms> block;
    for (const auto& [id, source] : frame.textures.sources())
        block.push_back(uniforms(source, frame.view));
    block.resize(max_cameras);  // shaders expect the whole array behind the binding
    glBindBuffer(GL_UNIFORM_BUFFER, buffer_.name());
    glBufferData(GL_UNIFORM_BUFFER, GLsizeiptr(block.size() * sizeof(CameraUniforms)), block.data(),
                 GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, binding, buffer_.name());
    frame.textures.bind();
}

Program make_cloud_program(ShaderFiles vertex, ShaderFiles fragment) {
    Program program(vertex, fragment);
    program.set_sampler("depth_images", 0);
    program.set_sampler("ray_tables", 1);
    program.set_sampler("color_images", 2);
    program.set_sampler("nearest_in_color", ColorVisibility::texture_unit);
    program.set_sampler("edge_distances", EdgeMaps::texture_unit);
    program.set_sampler("refined_depth", SurfaceMaps::refined_unit);
    program.set_sampler("surfaces", SurfaceMaps::texture_unit);
    program.bind_block("Cameras", CameraBlock::binding);
    return program;
}

void set_depth_from_w(const CameraView& view, GLint uniform) {
    const double n = view.near_m, f = view.far_m;
    glUniform2f(uniform, float(f / (f - n)), float(-f * n / (f - n)));
}

}  // namespace theatron::render
