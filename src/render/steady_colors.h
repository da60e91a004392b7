// SPDX-License-Identifier: Apache-2.0
// The cameras' colour pictures with less noise: a temporal filter that slows down small changes and
// takes over large ones at once.
//
// Sensor noise and its compression flicker by some steps of 255 even where nothing moves. Only
// changes of the size of that noise are slowed down, so that moving objects leave no visible
// trace.
#pragma once

#include "render/cloud_camera.h"
#include "render/gl.h"

namespace theatron::render {

class SteadyColors {
public:
    SteadyColors();

    // Draws the camera's picture if it is out of date. The camera must be bound. Changes
    // framebuffer, viewport and tests.
    void update(CloudCamera& camera);

    // Binds the newest picture to its unit.
    void bind(const CloudCamera& camera) const;

private:
    Program program_;
    GLint has_before_;
    Framebuffer framebuffer_;
};

}  // namespace theatron::render
