// SPDX-License-Identifier: Apache-2.0
// The passes that draw clouds: one object per way of drawing, which holds its
// programs, and a draw call over a description of the frame.
#pragma once

#include <map>
#include <memory>
#include <string_view>

#include "render/cloud_scene.h"
#include "render/cloud_textures.h"
#include "render/gl.h"
#include "render/grid_mesh.h"
#include "render/surface_maps.h"

namespace theatron::render {

// One look at the clouds.
struct CloudFrame {
    const CloudTextures& textures;
    const CameraView& view;
    DrawTarget target;
    GridMesh& grid;
};

class CloudPass {
public:
    virtual ~CloudPass() = default;
    // Draws maps that do not depend on the view and are out of date. Changes framebuffer,
    // viewport and tests.
    virtual void prepare(const CloudFrame&) {}
    // Target, depth test and masks are set; draws over what is there.
    virtual void draw(const CloudFrame& frame) = 0;
};

std::unique_ptr<CloudPass> make_splat_pass();
std::unique_ptr<CloudPass> make_disc_pass();
std::unique_ptr<CloudPass> make_mesh_pass();
std::unique_ptr<CloudPass> make_blend_pass();
std::unique_ptr<CloudPass> make_bare_grid_pass();

// The calibrations of a frame's cameras as the shaders read them (cloud.glsl).
class CameraBlock {
public:
    static constexpr unsigned binding = 0;
    // Uploads and binds the block, and the textures. The cameras are in the order of
    // textures.sources().
    void bind(const CloudFrame& frame) const;

private:
    Buffer buffer_;
};

// A program with cloud.glsl and its companions in it: samplers and block are bound as
// CloudTextures::bind, ColorVisibility::update, SurfaceMaps::update and
// CameraBlock::bind do.
Program make_cloud_program(ShaderFiles vertex, ShaderFiles fragment);

// Sets the current program's uniform depth_from_w, with which shaders turn distance
// into window depth and back.
void set_depth_from_w(const CameraView& view, GLint uniform);

}  // namespace theatron::render
