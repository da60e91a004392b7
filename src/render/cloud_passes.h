// SPDX-License-Identifier: Apache-2.0
// The passes that draw clouds: one object per renderer, which holds its programs, with a
// draw call that takes a description of the frame. A pass keeps no state of a camera, so that all
// sets of clouds share it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "render/cloud_camera.h"
#include "render/cloud_set.h"
#include "render/gl.h"

namespace theatron::render {

// A layer of the target's size for each camera of a set, for blending.
struct BlendLayers {
    std::optional<Texture> colors, depths;
    Size size;
    int count = 0;
};

// A set of clouds, drawn for one eye.
struct CloudFrame {
    const std::vector<CloudCamera*>& cameras;
    const CameraView& view;
    DrawTarget target;
    BlendLayers& layers;
    double point_size = 1;
};

class CloudPass {
public:
    virtual ~CloudPass() = default;
    // Updates a camera's maps that do not depend on the view, if they are out of date. The camera
    // must be bound. Changes framebuffer, viewport and tests.
    virtual void prepare(CloudCamera&) {}
    // Draws over the target's content. Target, depth test, masks and cameras' views must be set.
    virtual void draw(const CloudFrame& frame) = 0;
};

std::unique_ptr<CloudPass> make_splat_pass();
std::unique_ptr<CloudPass> make_disc_pass();
std::unique_ptr<CloudPass> make_mesh_pass();
std::unique_ptr<CloudPass> make_blend_pass();
std::unique_ptr<CloudPass> make_bare_grid_pass();

// The binding point of the uniform block of cloud.glsl.
inline constexpr unsigned camera_block_binding = 0;

// A program with cloud.glsl and its companions. Its block and samplers use the binding
// points of CloudCamera::bind and of the maps' classes (texture_units.h).
Program make_cloud_program(ShaderFiles vertex, ShaderFiles fragment);

}  // namespace theatron::render
