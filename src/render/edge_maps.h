// SPDX-License-Identifier: Apache-2.0
// How far each depth pixel is from the next edge of its surface, for blending: one small
// picture for each camera.
#pragma once

#include <array>
#include <optional>

#include "render/cloud_scene.h"
#include "render/gl.h"

namespace theatron::render {

class EdgeMaps {
public:
    static constexpr int texture_unit = 4;

    EdgeMaps();

    // Draws the map of one camera from refined depth (SurfaceMaps), which must be bound, and
    // binds the maps that have it to their unit. With `has_before` the map follows slowly what it
    // was for the frame before. Changes framebuffer and viewport.
    void draw(int camera, int layer, Size depth, int layers, bool has_before);

private:
    Program find_edges_, spread_;
    GLint camera_, layer_, has_before_;
    Framebuffer framebuffer_;
    std::optional<Texture> whole_;                // of one camera, between the two steps
    std::optional<Texture> distances_[2];         // of this frame and of the one before
    std::array<unsigned, max_cameras> newest_{};  // which of the two is which, by layer
    Size size_;
    int layers_ = 0;
};

}  // namespace theatron::render
