// SPDX-License-Identifier: Apache-2.0
// The triangles between the pixels of a depth image.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "image/view.h"
#include "render/gl.h"

namespace theatron::render {

class GridMesh {
public:
    explicit GridMesh(Size size) : size_(size) {}

    // Draws with the current program and vertex array. gl_VertexID counts the pixels row by
    // row; the last corner of each triangle is the upper left one of its cell.
    void draw();

private:
    Size size_;
    std::optional<Buffer> indices_;  // made when first drawn
    GLsizei count_ = 0;
};

// One grid for all cameras of one size.
class GridMeshes {
public:
    // The grid is freed with its last shared_ptr.
    std::shared_ptr<GridMesh> of(Size size);

private:
    std::map<std::pair<int, int>, std::weak_ptr<GridMesh>> grids_;
};

}  // namespace theatron::render
