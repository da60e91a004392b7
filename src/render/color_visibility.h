// SPDX-License-Identifier: Apache-2.0
// The surfaces that each colour camera sees, among those that its depth camera measured. Without
// this map the foreground's colours would also be painted on the surfaces that it hides.
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

// True if the colour camera needs such a map. A colour picture that is registered to the depth
// camera needs none.
bool may_be_hidden(const Calibration& calibration);

}  // namespace theatron::render
