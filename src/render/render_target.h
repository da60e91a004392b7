// SPDX-License-Identifier: Apache-2.0
// A target that can be read back: colour, and metric depth beside it.
#pragma once

#include "render/cloud_set.h"
#include "render/gl.h"

namespace theatron::render {

class RenderTarget {
public:
    explicit RenderTarget(Size size);

    DrawTarget target() const { return {framebuffer_.name(), 0, 0, size_}; }
    Size size() const { return size_; }
    // The picture's colours, the lower row first.
    const Texture& color() const { return color_; }

    void clear(Rgb background) const;
    // Reads the picture; waits for the GPU.
    Picture read() const;

private:
    Size size_;
    Texture color_, depth_mm_, depth_;
    Framebuffer framebuffer_;
};

}  // namespace theatron::render
