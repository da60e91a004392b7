// SPDX-License-Identifier: Apache-2.0
// The triangles between the pixels of a depth image, made once for each size.
#pragma once

#include "image/view.h"
#include "render/gl.h"

namespace theatron::render {

class GridMesh {
public:
    // Draws `instances` grids of this size with the current program and vertex array.
    // gl_VertexID counts the pixels row by row; the last corner of each triangle is
    // the upper left one of its cell.
    void draw(Size size, int instances);

private:
    Buffer indices_;
    Size size_;
    GLsizei count_ = 0;
};

}  // namespace theatron::render
