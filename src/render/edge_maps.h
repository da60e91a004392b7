// SPDX-License-Identifier: Apache-2.0
// How far each depth pixel is from the next edge of its surface, for blending: one small
// picture for each camera.
#pragma once

#include <optional>

#include "render/gl.h"

namespace theatron::render {

class EdgeMaps {
public:
    static constexpr int texture_unit = 4;

    EdgeMaps();

    // Draws the map of one camera from refined depth (SurfaceMaps), which must be bound, and
    // binds all maps to their unit. Changes framebuffer and viewport.
    void draw(int camera, int layer, Size depth, int layers);

private:
    Program find_edges_, spread_;
    GLint camera_;
    Framebuffer framebuffer_;
    std::optional<Texture> whole_;  // of one camera, between the two steps
    std::optional<Texture> distances_;
    Size size_;
    int layers_ = 0;
};

}  // namespace theatron::render
