// SPDX-License-Identifier: Apache-2.0
// A colour picture on the GPU whose content changes.
#pragma once

#include <optional>

#include "image/view.h"
#include "render/gl.h"

namespace theatron::render {

// Use it with the GL context current in which it was made, also in the destructor.
class PictureTexture {
public:
    // Binds to texture unit 0. An empty view removes the picture.
    void set(ColorView picture);
    // Zero where there is no picture.
    Size size() const { return size_; }
    // Only where there is a picture.
    const Texture& texture() const { return *texture_; }

private:
    std::optional<Texture> texture_;
    Size size_;
};

}  // namespace theatron::render
