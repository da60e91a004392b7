// SPDX-License-Identifier: Apache-2.0
// Maps of the distance of depth pixels from the next edge of their surface, for blending: one
// small picture for each camera.
#pragma once

#include "render/cloud_camera.h"
#include "render/gl.h"

namespace theatron::render {

class EdgeMaps {
public:
    EdgeMaps();

    // Draws the map of the bound camera from its refined depth (SurfaceMaps), which must be bound,
    // too. With `has_before` the map changes slowly from that of the previous frame.
    // Changes framebuffer and viewport.
    void draw(EdgeMap& map, Size depth, bool has_before);

private:
    Program find_edges_, spread_;
    GLint has_before_;
    Framebuffer framebuffer_;
};

}  // namespace theatron::render
