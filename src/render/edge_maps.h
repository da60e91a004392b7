// SPDX-License-Identifier: Apache-2.0
// How far each depth pixel is from the next edge of its surface, for blending: one small
// picture for each camera, drawn again when its depth changed.
#pragma once

#include <array>
#include <optional>

#include "render/cloud_scene.h"
#include "render/cloud_textures.h"
#include "render/gl.h"

namespace theatron::render {

class EdgeMaps {
public:
    static constexpr int texture_unit = 4;

    EdgeMaps();

    // Draws the maps that are out of date, and binds them to their unit. CameraBlock must
    // be bound with these textures' cameras. Changes framebuffer, viewport and tests.
    void update(const CloudTextures& textures);

private:
    Program find_edges_, spread_;
    GLint camera_;
    Framebuffer framebuffer_;
    std::optional<Texture> whole_;  // of one camera, between the two steps
    std::optional<Texture> distances_;
    Size size_;
    int layers_ = 0;
    std::array<unsigned, max_cameras> drawn_{};  // CloudSource::revision, by layer
};

}  // namespace theatron::render
