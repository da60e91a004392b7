// SPDX-License-Identifier: Apache-2.0
// Lines of text in the room, from a FontAtlas.
#pragma once

#include <string_view>
#include <vector>

#include "render/camera_view.h"
#include "render/font_atlas.h"
#include "render/gl.h"
#include "render/matrix.h"
#include "render/scene_frame.h"

namespace theatron::render {

class TextPass {
public:
    explicit TextPass(const FontAtlas& atlas);

    // Blending must be on. Letters that the atlas lacks leave a gap.
    void draw(const std::vector<SceneText>& texts, const CameraView& view);

    // The length of a line of text, in heights of its capital letters.
    double length_of(std::string_view utf8) const;
    // One line of text whose base line begins at the origin, with x along it and y down.
    void draw_line(std::string_view utf8, const Mat4& clip_from_text, double height, Rgb color);

private:
    const FontAtlas::Glyph* glyph_of(char32_t letter) const;

    FontAtlas atlas_;  // its picture is on the GPU alone
    Size size_;
    Texture distances_;
    Program program_{{"text.vert"}, {"output.glsl", "text.frag"}};
    GLint clip_from_text_ = program_.uniform("clip_from_text");
    GLint color_ = program_.uniform("color");
    VertexArray attributes_;  // 0: place in the text's frame, 1: place in the atlas
    Buffer vertices_;
};

}  // namespace theatron::render
