// SPDX-License-Identifier: Apache-2.0
// What each colour camera sees of what its depth camera measured: without it the
// colours of the foreground would also be painted on what is hidden behind.
//
// One small depth map for each camera, drawn again when the camera's images or lenses
// changed, not for each view.
#pragma once

#include "render/cloud_camera.h"
#include "render/gl.h"

namespace theatron::render {

class ColorVisibility {
public:
    ColorVisibility();

    // Draws the camera's map if it is out of date. The camera must be bound. Changes framebuffer
    // and viewport, and leaves the map bound to its unit.
    void update(CloudCamera& camera);

private:
    Program program_;
    GLint blocks_per_row_, map_size_;
    Framebuffer framebuffer_;
};

// Whether a colour camera needs a map: not if its pictures are already those of
// the depth camera.
bool may_be_hidden(const Calibration& calibration);

}  // namespace theatron::render
