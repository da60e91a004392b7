// SPDX-License-Identifier: Apache-2.0
#include "render/cloud_camera.h"

#include <utility>

#include "geometry/ray_table.h"
#include "render/cloud_passes.h"
#include "render/color_visibility.h"
#include "render/matrix.h"
#include "render/shades.h"
#include "render/texture_units.h"

namespace theatron::render {
namespace {

// The share of the way to the calibration's gains that each image brings: at 30 images a second
// most of it takes a second.
constexpr double gain_step = 0.07;

// Uses a buffer that gets new memory each time, so that the call waits neither for drawing from
// the texture nor for the last upload.
template <class Image>
void upload_image(const Buffer& staging, const Texture& texture, Image image, GLenum format,
                  GLenum type) {
    const auto pixels = std::size_t(image.stride) * std::size_t(image.size.height - 1) +
                        std::size_t(image.size.width);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, staging.name());
    glBufferData(GL_PIXEL_UNPACK_BUFFER, GLsizeiptr(pixels * sizeof(*image.pixels)), image.pixels,
                 GL_STREAM_DRAW);
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, GLint(image.stride));
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.size.width, image.size.height, format, type,
                    nullptr);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

// `Camera` in cloud.glsl, in the layout std140.
struct CameraUniforms {
    float clip_from_camera[16];
    float color_from_camera[16];
    float color_pinhole[4];
    float color_radial[4];
    float color_more[4];
    float color_image[4];
    float depth[4];
    float viewer[4];
    float color_gain[4];
    float keep[4];
    float remove_from[4];
    float remove_to[4];
};
static_assert(sizeof(CameraUniforms) == 288);

// Its colour picture is made of its depth: shades.h.
bool has_no_color(const Calibration& calibration) {
    return calibration.color.size == Size{};
}

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

CameraUniforms uniforms(const CloudCamera& camera, const CameraView& view) {
    const Calibration& calibration = camera.calibration();
    const Pose eye_from_camera = inverse(view.room_from_eye) * calibration.room_from_camera;
    CameraUniforms u{};
    put(u.clip_from_camera, projection(view) * matrix(eye_from_camera));
    const bool is_shaded = has_no_color(calibration);
    put(u.color_from_camera, matrix(is_shaded ? Pose{} : calibration.color_from_depth));
    // Without a colour picture its size is 0, so that every point lies outside.
    if (camera.color_size() != Size{}) {
        const CameraModel color =
            scaled(is_shaded ? calibration.depth : calibration.color, camera.color_size());
        put(u.color_pinhole, color.fx, color.fy, color.cx, color.cy);
        put(u.color_radial, color.k[0], color.k[1], color.k[2], color.k[3]);
        put(u.color_more, color.k[4], color.k[5], color.p1, color.p2);
        put(u.color_image, color.size.width, color.size.height, color.max_radius,
            is_shaded                    ? -1
            : may_be_hidden(calibration) ? 1
                                         : 0);
    }
    const double offset_m =
        calibration.depth_offset_mm ? *calibration.depth_offset_mm / 1000 : camera.depth_offset_m;
    put(u.depth, calibration.depth_unit_mm / 1000, camera.tan_per_pixel(), offset_m, 0);
    const Vec3 viewer = inverse(eye_from_camera).translation;
    put(u.viewer, viewer.x, viewer.y, viewer.z, 0);
    const Vec3 gain = camera.color_gain;
    put(u.color_gain, gain.x, gain.y, gain.z, camera.presence);
    put_cut(u, camera.cut, inverse(calibration.room_from_camera));
    return u;
}

// True if the two differ at most in the camera's place in the room and in its gains.
bool same_images(Calibration a, const Calibration& b) {
    a.room_from_camera = b.room_from_camera;
    a.registered = b.registered;
    a.registration = b.registration;
    a.covariance = b.covariance;
    a.color_gain = b.color_gain;
    return a == b;
}

}  // namespace

CloudCamera::CloudCamera(const Calibration& calibration, std::shared_ptr<GridMesh> grid)
    : calibration_(calibration), grid_(std::move(grid)) {
    const Buffer staging;
    glActiveTexture(GL_TEXTURE0 + texture_unit::depth_image);
    depth_ = make_texture(GL_R16UI, depth_size(), GL_NEAREST);
    upload_image(staging, depth_, DepthImage(depth_size()).view(), GL_RED_INTEGER,
                 GL_UNSIGNED_SHORT);
    rays_ = make_texture(GL_RG32F, depth_size(), GL_NEAREST);
    upload_image(staging, rays_, make_ray_table(calibration.depth).view(), GL_RG, GL_FLOAT);
}

void CloudCamera::set_calibration(const Calibration& calibration) {
    if (!same_images(calibration_, calibration))
        ++content_;
    calibration_ = calibration;
}

void CloudCamera::take_settings(const CloudCamera& before) {
    presence = before.presence;
    color_gain = before.color_gain;
    depth_offset_m = before.depth_offset_m;
    cut = before.cut;
}

Status CloudCamera::upload(DepthView depth, ColorView color, const Buffer& staging) {
    if (depth.size != depth_size() || color.size.area() > max_color_pixels)
        return Status::size_mismatch;
    if (const auto& goal = calibration_.color_gain)
        color_gain = images_ == 0 ? *goal : color_gain + (*goal - color_gain) * gain_step;
    ++images_;
    ++content_;
    glActiveTexture(GL_TEXTURE0 + texture_unit::depth_image);
    upload_image(staging, depth_, depth, GL_RED_INTEGER, GL_UNSIGNED_SHORT);
    if (has_no_color(calibration_)) {
        shade(depth, calibration_, shades_);
        color = std::as_const(shades_).view();
    }
    if (color.pixels) {
        if (color.size != color_size_)
            color_ = make_texture(GL_RGB8, color.size, GL_LINEAR);
        upload_image(staging, *color_, color, GL_RGB, GL_UNSIGNED_BYTE);
        color_size_ = color.size;
        ++colors_;
    }
    return Status::ok;
}

void CloudCamera::set_view(const CameraView& view) {
    const CameraUniforms u = uniforms(*this, view);
    glBindBuffer(GL_UNIFORM_BUFFER, block_.name());
    glBufferData(GL_UNIFORM_BUFFER, sizeof(u), &u, GL_STREAM_DRAW);
}

void CloudCamera::bind() const {
    glBindBufferBase(GL_UNIFORM_BUFFER, camera_block_binding, block_.name());
    bind_texture(texture_unit::depth_image, &depth_);
    bind_texture(texture_unit::rays, &rays_);
    bind_texture(texture_unit::color_picture, color_ ? &*color_ : nullptr);
    bind_texture(texture_unit::nearest_in_color,
                 visibility.nearest ? &*visibility.nearest : nullptr);
}

}  // namespace theatron::render
