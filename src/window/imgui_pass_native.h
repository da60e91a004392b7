// SPDX-License-Identifier: Apache-2.0
// Draws the draw data of Dear ImGui with OpenGL ES 3, into the window or onto a panel. An
// ImTextureID is the GL name of a texture with colours, see texture_of().
#pragma once

#include <imgui.h>

#include <cstdint>

#include "render/draw_target.h"
#include "render/gl.h"
#include "render/scene_frame.h"

namespace theatron::window {

class ImGuiPass {
public:
    // Throws Error where the driver does not accept the shaders.
    ImGuiPass();

    // Call it after the fonts of the current ImGui context were built.
    void upload_fonts();
    // Draws into the window's framebuffer.
    void draw(const ImDrawData& data);
    // Draws over the whole of a framebuffer.
    void draw(const ImDrawData& data, const render::DrawTarget& target);
    // Draws over the whole of a texture, on a background of this colour: for a panel that stands
    // in the room.
    void draw(const ImDrawData& data, render::SceneTexture& panel, Rgb background);

private:
    // The target of ImGui's display.
    struct Picture {
        unsigned framebuffer = 0;
        Size size;
        bool first_row_on_top = false;
    };
    void draw(const ImDrawData& data, const Picture& picture);

    struct ProgramKind {
        static GLuint make() { return glCreateProgram(); }
        static void destroy(GLuint name) { glDeleteProgram(name); }
    };
    render::GlObject<ProgramKind> program_;
    GLint window_uniform_ = -1, upwards_uniform_ = -1, has_colors_uniform_ = -1;
    render::VertexArray vertex_array_;
    render::Buffer vertices_, indices_;
    render::Texture fonts_;
};

// For ImDrawList::AddImage(). The texture must exist until the data are drawn.
inline ImTextureID texture_of(const render::Texture& colors) {
    return reinterpret_cast<ImTextureID>(std::uintptr_t(colors.name()));
}

}  // namespace theatron::window
