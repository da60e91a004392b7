// SPDX-License-Identifier: Apache-2.0
// What is known of each depth pixel whatever the view: drawn once for each new image,
// read by the vertices of every view. One layer for each camera.
#pragma once

#include <array>
#include <optional>

#include "render/cloud_scene.h"
#include "render/cloud_textures.h"
#include "render/edge_maps.h"
#include "render/gl.h"

namespace theatron::render {

class SurfaceMaps {
public:
    static constexpr int texture_unit = 8, refined_unit = 7, refined_before_unit = 9;

    enum class Kind {
        measured,  // depth as it is
        refined,   // less noise, small gaps closed, with a quality for blending
    };
    explicit SurfaceMaps(Kind kind);

    // Draws the maps that are out of date, and binds them to their unit. CameraBlock must
    // be bound with these textures' cameras, ColorVisibility up to date. Changes
    // framebuffer, viewport and tests.
    void update(const CloudTextures& textures);

private:
    void make_maps(const CloudTextures& textures);
    void refine(int camera, int layer, bool has_before);

    Kind kind_;
    Program find_surface_;
    GLint camera_;
    std::optional<Program> refine_;
    std::optional<EdgeMaps> edges_;
    Framebuffer framebuffer_;
    std::optional<Texture> maps_;
    std::optional<Texture> refined_[2];           // of this frame and of the one before
    std::array<unsigned, max_cameras> newest_{};  // which of the two is which, by layer
    Size size_;
    int layers_ = 0;
    std::array<unsigned, max_cameras> drawn_{};  // CloudSource::revision, by layer
};

}  // namespace theatron::render
