// SPDX-License-Identifier: Apache-2.0
// The inside of SceneMesh.
#pragma once

#include <optional>
#include <vector>

#include "render/gl.h"
#include "render/scene_frame.h"
#include "render/triangle_tree.h"

namespace theatron::render {

struct SceneMesh::Buffers {
    VertexArray attributes;  // 0: place, 1: normal, 2: place in the texture, 3: colour
    Buffer vertices, indices, colors;
    bool has_colors = false;
    GLsizei count = 0;
    Vec3 middle;  // of a ball around all corners
    double radius_m = 0;
    std::vector<TriangleTree::Triangle> triangles;  // until the tree is made
    std::optional<TriangleTree> tree;

    void draw() const;
};

struct SceneTexture::Parts {
    Size size;
    Texture texture;
    Framebuffer framebuffer;
};

}  // namespace theatron::render
