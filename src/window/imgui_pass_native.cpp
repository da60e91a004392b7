// SPDX-License-Identifier: Apache-2.0
#include "window/imgui_pass_native.h"

#include <cstddef>

#include "base/error.h"

namespace theatron::window {
namespace {

// Places are in pixels from the top left corner.
constexpr const char* vertex_shader = R"(
uniform vec2 window;
uniform float upwards;  // 1: the upper row is the picture's last one, as in windows; -1: its first
layout(location = 0) in vec2 place;
layout(location = 1) in vec2 glyph;
layout(location = 2) in vec4 color;
out vec2 v_glyph;
out vec4 v_color;
void main() {
    v_glyph = glyph;
    v_color = color;
    vec2 unit = place / window;
    gl_Position = vec4(2.0 * unit.x - 1.0, upwards * (1.0 - 2.0 * unit.y), 0.0, 1.0);
}
)";

// The texture holds how much of a pixel a letter covers; areas use one that is covered. A texture
// with colours is a picture.
constexpr const char* fragment_shader = R"(
uniform sampler2D glyphs;
uniform bool has_colors;
in vec2 v_glyph;
in vec4 v_color;
out vec4 out_color;
void main() {
    vec4 texel = texture(glyphs, v_glyph);
    out_color = has_colors ? vec4(v_color.rgb * texel.rgb, v_color.a)
                           : vec4(v_color.rgb, v_color.a * texel.r);
}
)";

void attribute(GLuint location, GLint count, GLenum type, GLboolean normalised,
               std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, count, type, normalised, sizeof(ImDrawVert),
                          reinterpret_cast<const void*>(offset));
}

}  // namespace

ImGuiPass::ImGuiPass() {
    const GLuint shaders[] = {
        render::compile_shader(GL_VERTEX_SHADER, {{"overlay.vert", vertex_shader}}),
        render::compile_shader(GL_FRAGMENT_SHADER, {{"overlay.frag", fragment_shader}})};
    for (const GLuint shader : shaders) {
        glAttachShader(program_.name(), shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program_.name());
    GLint linked = 0;
    glGetProgramiv(program_.name(), GL_LINK_STATUS, &linked);
    if (!linked)
        throw Error("The graphics driver does not accept the shaders of the texts.");
    window_uniform_ = glGetUniformLocation(program_.name(), "window");
    upwards_uniform_ = glGetUniformLocation(program_.name(), "upwards");
    has_colors_uniform_ = glGetUniformLocation(program_.name(), "has_colors");

    glBindVertexArray(vertex_array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
    attribute(0, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, pos));
    attribute(1, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, uv));
    attribute(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(ImDrawVert, col));
    glBindVertexArray(0);
}

void ImGuiPass::upload_fonts() {
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    fonts_ = {};  // another size: the storage of a texture is final
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, fonts_.name());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_R8, width, height);
    render::set_sampling(GL_TEXTURE_2D, GL_LINEAR);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RED, GL_UNSIGNED_BYTE, pixels);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

void ImGuiPass::draw(const ImDrawData& data) {
    draw(data, Picture{0, {int(data.DisplaySize.x), int(data.DisplaySize.y)}, false});
}

void ImGuiPass::draw(const ImDrawData& data, const render::DrawTarget& target) {
    draw(data, Picture{target.framebuffer, target.size, false});
}

void ImGuiPass::draw(const ImDrawData& data, render::SceneTexture& panel, Rgb background) {
    const render::DrawTarget target = panel.target();
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    const float color[] = {background.r / 255.0f, background.g / 255.0f, background.b / 255.0f, 1};
    glClearBufferfv(GL_COLOR, 0, color);
    draw(data, Picture{target.framebuffer, target.size, true});
    panel.finish();
}

void ImGuiPass::draw(const ImDrawData& data, const Picture& picture) {
    glBindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer);
    glViewport(0, 0, picture.size.width, picture.size.height);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    // A panel stays opaque.
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_SCISSOR_TEST);

    glUseProgram(program_.name());
    glUniform2f(window_uniform_, data.DisplaySize.x, data.DisplaySize.y);
    glUniform1f(upwards_uniform_, picture.first_row_on_top ? -1.0f : 1.0f);
    const float scale_x = float(picture.size.width) / data.DisplaySize.x;
    const float scale_y = float(picture.size.height) / data.DisplaySize.y;
    glActiveTexture(GL_TEXTURE0);
    glBindVertexArray(vertex_array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(list.VtxBuffer.size_in_bytes()),
                     list.VtxBuffer.Data, GL_STREAM_DRAW);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(list.IdxBuffer.size_in_bytes()),
                     list.IdxBuffer.Data, GL_STREAM_DRAW);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const auto picture_name = GLuint(reinterpret_cast<std::uintptr_t>(command.GetTexID()));
            glBindTexture(GL_TEXTURE_2D, picture_name != 0 ? picture_name : fonts_.name());
            glUniform1i(has_colors_uniform_, picture_name != 0);
            const ImVec4 clip = command.ClipRect;  // left, top, right, bottom
            const float first_row = picture.first_row_on_top ? clip.y : data.DisplaySize.y - clip.w;
            glScissor(GLint(clip.x * scale_x), GLint(first_row * scale_y),
                      GLsizei((clip.z - clip.x) * scale_x), GLsizei((clip.w - clip.y) * scale_y));
            const std::size_t first = command.IdxOffset * sizeof(ImDrawIdx);
            glDrawElements(GL_TRIANGLES, GLsizei(command.ElemCount),
                           sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                           reinterpret_cast<const void*>(first));
        }
    }
    glBindVertexArray(0);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
}

}  // namespace theatron::window
