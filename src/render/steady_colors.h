// SPDX-License-Identifier: Apache-2.0
// The cameras' colour pictures with less noise: what stays as it was follows its noise slowly, what
// changes is taken as it is.
//
// Sensor noise and its compression flicker by some steps of 255 even where nothing moves. Only
// changes of the size of that noise are slowed down, so that nothing moving leaves a trace that
// could be seen.
#pragma once

#include <array>
#include <optional>

#include "render/cloud_scene.h"
#include "render/cloud_textures.h"
#include "render/gl.h"

namespace theatron::render {

class SteadyColors {
public:
    static constexpr int texture_unit = 10, before_unit = 11;

    SteadyColors();

    // Draws the pictures that are out of date. Changes framebuffer, viewport and tests.
    void update(const CloudTextures& textures);

    // Binds the array that has a camera's newest picture, in the layer that it has in
    // color_images, to its unit.
    void bind(const CloudSource& source) const;

private:
    struct State {
        unsigned revision = 0;  // CloudSource::revision of what was drawn
        Size size;              // of the picture
        unsigned newest = 0;    // in which array it is
    };
    void make_pictures(const CloudTextures& textures);
    void draw(const CloudSource& source);

    Program program_;
    GLint layer_, has_before_;
    Framebuffer framebuffer_;
    std::optional<Texture> pictures_[2];
    Size size_;
    int layers_ = 0;
    std::array<State, max_cameras> drawn_{};  // by layer
};

}  // namespace theatron::render
