// SPDX-License-Identifier: Apache-2.0
// Properties of each depth pixel that do not depend on the view. They are drawn once for each new
// image and read by the vertices of every view.
#pragma once

#include <optional>

#include "render/cloud_camera.h"
#include "render/edge_maps.h"
#include "render/gl.h"

namespace theatron::render {

class SurfaceMaps {
public:
    enum class Kind {
        measured,  // depth as it is
        refined,   // less noise, small gaps closed, with a quality for blending
    };
    explicit SurfaceMaps(Kind kind);

    // Draws the camera's map if it is out of date. The camera must be bound, its map of
    // ColorVisibility up to date. Changes framebuffer, viewport and tests.
    void update(CloudCamera& camera);

    // Binds the camera's map to its unit.
    void bind(const CloudCamera& camera) const;

private:
    void refine(SurfaceMap& map, Size size);

    Kind kind_;
    Program find_surface_;
    std::optional<Program> refine_;
    GLint has_before_ = -1;
    std::optional<EdgeMaps> edges_;
    Framebuffer framebuffer_;
};

}  // namespace theatron::render
