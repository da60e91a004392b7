// SPDX-License-Identifier: Apache-2.0
// What each colour camera sees of what its depth camera measured: without it the
// colours of the foreground would also be painted on what is hidden behind.
//
// One small depth map for each camera, drawn again when the camera's images or
// calibration changed, not for each view.
#pragma once

#include <array>
#include <optional>

#include "render/cloud_scene.h"
#include "render/cloud_textures.h"
#include "render/gl.h"

namespace theatron::render {

class ColorVisibility {
public:
    static constexpr int texture_unit = 3;

    ColorVisibility();

    // Draws the maps that are out of date, and binds them to their unit. CameraBlock must
    // be bound with these textures' cameras. Changes framebuffer and viewport.
    void update(const CloudTextures& textures);

private:
    void draw_map(const CloudTextures& textures, const CloudSource& source, int camera);

    Program program_;
    GLint camera_, blocks_per_row_, map_size_;
    Framebuffer framebuffer_;
    std::optional<Texture> maps_;
    Size size_;
    int layers_ = 0;
    std::array<unsigned, max_cameras> drawn_{};  // CloudSource::revision, by layer
};

// Whether a colour camera needs a map: not if its pictures are already those of
// the depth camera.
bool may_be_hidden(const Calibration& calibration);

}  // namespace theatron::render
