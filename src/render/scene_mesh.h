// SPDX-License-Identifier: Apache-2.0
// The inside of SceneMesh.
#pragma once

#include "render/gl.h"
#include "render/scene_frame.h"

namespace theatron::render {

struct SceneMesh::Buffers {
    VertexArray attributes;  // 0: place, 1: normal
    Buffer vertices, indices;
    GLsizei count = 0;

    void draw() const;
};

}  // namespace theatron::render
