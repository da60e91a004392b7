// SPDX-License-Identifier: Apache-2.0
// How far each depth pixel is from the next edge of its surface, for blending: one small
// picture for each camera.
#pragma once

#include "render/cloud_camera.h"
#include "render/gl.h"

namespace theatron::render {

class EdgeMaps {
public:
    EdgeMaps();

    // Draws the map of the camera that is bound, from refined depth (SurfaceMaps), which must be
    // bound, too. With `has_before` the map follows slowly what it was for the frame before.
    // Changes framebuffer and viewport.
    void draw(EdgeMap& map, Size depth, bool has_before);

private:
    Program find_edges_, spread_;
    GLint has_before_;
    Framebuffer framebuffer_;
};

}  // namespace theatron::render
