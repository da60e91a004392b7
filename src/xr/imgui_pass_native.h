// SPDX-License-Identifier: Apache-2.0
// Draws what Dear ImGui has put together, with OpenGL ES 3.
#pragma once

#include <imgui.h>

#include "render/gl.h"

namespace theatron::xr {

class ImGuiPass {
public:
    // Throws Error where the driver does not accept the shaders.
    ImGuiPass();

    // After the fonts of the current ImGui context were built.
    void upload_fonts();
    // Into the window's framebuffer.
    void draw(const ImDrawData& data);

private:
    struct ProgramKind {
        static GLuint make() { return glCreateProgram(); }
        static void destroy(GLuint name) { glDeleteProgram(name); }
    };
    render::GlObject<ProgramKind> program_;
    GLint window_uniform_ = -1;
    render::VertexArray vertex_array_;
    render::Buffer vertices_, indices_;
    render::Texture fonts_;
};

}  // namespace theatron::xr
