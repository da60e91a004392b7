// SPDX-License-Identifier: Apache-2.0
// Lines of text in the room, from a FontAtlas.
#pragma once

#include <vector>

#include "render/camera_view.h"
#include "render/font_atlas.h"
#include "render/gl.h"
#include "render/scene_frame.h"

namespace theatron::render {

class TextPass {
public:
    explicit TextPass(const FontAtlas& atlas);

    // Blending must be on. Letters that the atlas lacks leave a gap.
    void draw(const std::vector<SceneText>& texts, const CameraView& view);

private:
    FontAtlas atlas_;  // its picture is on the GPU alone
    Size size_;
    Texture distances_;
    Program program_{{"text.vert"}, {"output.glsl", "text.frag"}};
    VertexArray attributes_;  // 0: place in the text's frame, 1: place in the atlas
    Buffer vertices_;
};

}  // namespace theatron::render
