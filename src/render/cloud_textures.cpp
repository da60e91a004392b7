// SPDX-License-Identifier: Apache-2.0
#include "render/cloud_textures.h"

#include <algorithm>

#include "base/error.h"
#include "render/cloud_scene.h"

namespace theatron::render {
namespace {

Size larger(Size a, Size b) {
    return {std::max(a.width, b.width), std::max(a.height, b.height)};
}

// By way of a buffer that gets new memory each time: neither waits for the GPU to be done with
// what it still draws from the texture or from the last upload.
template <class Image>
void upload_layer(const Buffer& staging, const Texture& texture, int layer, Image image,
                  GLenum format, GLenum type) {
    const auto pixels = std::size_t(image.stride) * std::size_t(image.size.height - 1) +
                        std::size_t(image.size.width);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, staging.name());
    glBufferData(GL_PIXEL_UNPACK_BUFFER, GLsizeiptr(pixels * sizeof(*image.pixels)), image.pixels,
                 GL_STREAM_DRAW);
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, GLint(image.stride));
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, image.size.width, image.size.height, 1,
                    format, type, nullptr);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

void clear_depth(const Buffer& staging, const Texture& texture, Size size, int layer) {
    const DepthImage nothing(size);
    upload_layer(staging, texture, layer, nothing.view(), GL_RED_INTEGER, GL_UNSIGNED_SHORT);
}

}  // namespace

void CloudTextures::set_camera(CameraId camera, const Calibration& calibration) {
    const auto known = sources_.find(camera);
    if (known != sources_.end() && known->second.calibration.depth == calibration.depth) {
        known->second.calibration = calibration;
        known->second.revision = ++revision_;
        return;
    }
    if (known == sources_.end() && sources_.size() == std::size_t(max_cameras))
        throw Error("A scene shows at most " + std::to_string(max_cameras) + " cameras.");

    if (larger(calibration.depth.size, depth_size_).area() > max_layer_depth_pixels ||
        larger(calibration.color.size, color_size_).area() > max_layer_color_pixels)
        throw Error("The cameras' pictures are too large to be shown together.");

    CloudSource source;
    if (known != sources_.end()) {
        source.presence = known->second.presence;
        source.color_gain = known->second.color_gain;
        source.cut = known->second.cut;
    }
    source.calibration = calibration;
    source.revision = ++revision_;
    source.rays = make_ray_table(calibration.depth);
    source.layer = known != sources_.end() ? known->second.layer : free_layer();
    make_room(source.layer + 1, calibration.depth.size, calibration.color.size);
    upload_layer(staging_, *rays_, source.layer, source.rays.view(), GL_RG, GL_FLOAT);
    clear_depth(staging_, *depth_, depth_size_, source.layer);
    sources_[camera] = std::move(source);
}

void CloudTextures::set_presence(CameraId camera, double presence) {
    if (const auto known = sources_.find(camera); known != sources_.end())
        known->second.presence = std::clamp(presence, 0.0, 1.0);
}

void CloudTextures::set_cut(CameraId camera, const CloudCut& cut) {
    if (const auto known = sources_.find(camera); known != sources_.end())
        known->second.cut = cut;
}

void CloudTextures::set_color_gain(CameraId camera, Vec3 gain) {
    if (const auto known = sources_.find(camera); known != sources_.end())
        known->second.color_gain = gain;
}

void CloudTextures::set_depth_offset(CameraId camera, double offset_m) {
    if (const auto known = sources_.find(camera); known != sources_.end())
        known->second.depth_offset_m = offset_m;
}

void CloudTextures::remove_camera(CameraId camera) {
    sources_.erase(camera);
}

Status CloudTextures::upload(CameraId camera, DepthView depth, ColorView color) {
    const auto known = sources_.find(camera);
    if (known == sources_.end() || depth.size != known->second.calibration.depth.size ||
        larger(color.size, color_size_).area() > max_layer_color_pixels)
        return Status::size_mismatch;
    CloudSource& source = known->second;
    source.revision = ++revision_;
    upload_layer(staging_, *depth_, source.layer, depth, GL_RED_INTEGER, GL_UNSIGNED_SHORT);
    if (color.pixels) {
        make_room(0, {}, color.size);
        upload_layer(staging_, *color_, source.layer, color, GL_RGB, GL_UNSIGNED_BYTE);
        source.color_size = color.size;
    }
    return Status::ok;
}

void CloudTextures::bind() const {
    const std::optional<Texture>* const textures[] = {&depth_, &rays_, &color_};
    for (unsigned unit = 0; unit < 3; ++unit) {
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(GL_TEXTURE_2D_ARRAY, *textures[unit] ? (*textures[unit])->name() : 0);
    }
    glActiveTexture(GL_TEXTURE0);
}

// Replaces the textures by larger ones where they do not hold what is asked for.
void CloudTextures::make_room(int layers, Size depth, Size color) {
    const int new_layers = std::max(layers, layers_);
    const Size new_depth = larger(depth, depth_size_);
    const Size new_color = larger(color, larger(color_size_, {1, 1}));
    if (new_layers != layers_ || new_depth != depth_size_) {
        Texture moved = make_texture_array(GL_R16UI, new_depth, new_layers, GL_NEAREST);
        for (int layer = 0; layer < new_layers; ++layer)
            clear_depth(staging_, moved, new_depth, layer);
        for (const auto& [id, source] : sources_)
            copy_layer(*depth_, moved, source.layer, source.calibration.depth.size);
        depth_ = std::move(moved);
        depth_size_ = new_depth;

        // Not every driver can copy float textures.
        rays_ = make_texture_array(GL_RG32F, new_depth, new_layers, GL_NEAREST);
        for (const auto& [id, source] : sources_)
            upload_layer(staging_, *rays_, source.layer, source.rays.view(), GL_RG, GL_FLOAT);
    }
    if (new_layers != layers_ || new_color != color_size_) {
        Texture moved = make_texture_array(GL_RGB8, new_color, new_layers, GL_LINEAR);
        for (const auto& [id, source] : sources_)
            if (source.color_size != Size{})
                copy_layer(*color_, moved, source.layer, source.color_size);
        color_ = std::move(moved);
        color_size_ = new_color;
    }
    layers_ = new_layers;
}

void CloudTextures::copy_layer(const Texture& from, const Texture& to, int layer, Size size) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, copy_source_.name());
    glFramebufferTextureLayer(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, from.name(), 0, layer);
    glBindTexture(GL_TEXTURE_2D_ARRAY, to.name());
    glCopyTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, 0, 0, size.width, size.height);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

int CloudTextures::free_layer() const {
    const auto taken = [&](int layer) {
        for (const auto& [id, source] : sources_)
            if (source.layer == layer)
                return true;
        return false;
    };
    int layer = 0;
    while (taken(layer))
        ++layer;
    return layer;
}

}  // namespace theatron::render
