// SPDX-License-Identifier: Apache-2.0
// The passes that draw clouds: one object per way of drawing, which holds its
// programs, and a draw call over a description of the frame. Nothing of any camera is kept in them,
// so that all sets of clouds share them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "render/cloud_camera.h"
#include "render/cloud_set.h"
#include "render/gl.h"

namespace theatron::render {

// A picture of the size of the target for each camera of a set, to be blended.
struct BlendLayers {
    std::optional<Texture> colors, depths;
    Size size;
    int count = 0;
};

// A set of clouds as seen from one eye.
struct CloudFrame {
    const std::vector<CloudCamera*>& cameras;
    const CameraView& view;
    DrawTarget target;
    BlendLayers& layers;
};

class CloudPass {
public:
    virtual ~CloudPass() = default;
    // Draws maps of a camera that do not depend on the view and are out of date. The camera is
    // bound. Changes framebuffer, viewport and tests.
    virtual void prepare(CloudCamera&) {}
    // Target, depth test and masks are set, every camera's view is; draws over what is there.
    virtual void draw(const CloudFrame& frame) = 0;
};

std::unique_ptr<CloudPass> make_splat_pass();
std::unique_ptr<CloudPass> make_disc_pass();
std::unique_ptr<CloudPass> make_mesh_pass();
std::unique_ptr<CloudPass> make_blend_pass();
std::unique_ptr<CloudPass> make_bare_grid_pass();

// Where the block of cloud.glsl is bound.
inline constexpr unsigned camera_block_binding = 0;

// A program with cloud.glsl and its companions in it: block and samplers read what
// CloudCamera::bind and the maps' classes bind (texture_units.h).
Program make_cloud_program(ShaderFiles vertex, ShaderFiles fragment);

// Sets the current program's uniform depth_from_w, with which shaders turn distance
// into window depth and back.
void set_depth_from_w(const CameraView& view, GLint uniform);

}  // namespace theatron::render
