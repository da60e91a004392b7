// SPDX-License-Identifier: Apache-2.0
#include "render/text_pass.h"

#include "base/utf8.h"
#include "render/glyphs.h"
#include "render/matrix.h"

namespace theatron::render {
namespace {

constexpr int atlas_unit = 2;

}  // namespace

TextPass::TextPass(const FontAtlas& atlas) : atlas_(atlas), size_(atlas.distances.size) {
    glActiveTexture(GL_TEXTURE0 + atlas_unit);
    glBindTexture(GL_TEXTURE_2D, distances_.name());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_R8, size_.width, size_.height);
    set_sampling(GL_TEXTURE_2D, GL_LINEAR);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size_.width, size_.height, GL_RED, GL_UNSIGNED_BYTE,
                    atlas.distances.pixels.data());
    atlas_.distances = {};
    program_.set_sampler("distances", atlas_unit);
    glBindVertexArray(attributes_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    for (GLuint i = 0; i < 2; ++i) {
        glEnableVertexAttribArray(i);
        glVertexAttribPointer(i, 2, GL_FLOAT, GL_FALSE, 4 * sizeof(float),
                              reinterpret_cast<const void*>(i * 2 * sizeof(float)));
    }
    glBindVertexArray(0);
}

void TextPass::draw(const std::vector<SceneText>& texts, const CameraView& view) {
    program_.use();
    glActiveTexture(GL_TEXTURE0 + atlas_unit);
    glBindTexture(GL_TEXTURE_2D, distances_.name());
    glBindVertexArray(attributes_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    const Mat4 clip_from_room = projection(view) * matrix(inverse(view.room_from_eye));
    for (const SceneText& text : texts) {
        const double scale = text.height_m / atlas_.capital_height;
        std::vector<float> corners;
        double pen = 0;
        std::string_view rest = text.utf8;
        while (!rest.empty()) {
            const Utf8Character letter = first_character(rest);
            rest.remove_prefix(letter.bytes);
            auto known = atlas_.glyphs.find(letter.code);
            if (known == atlas_.glyphs.end())
                known = atlas_.glyphs.find(unknown_glyph);
            if (known == atlas_.glyphs.end()) {
                pen += 0.5 * atlas_.capital_height;
                continue;
            }
            const FontAtlas::Glyph& g = known->second;
            for (const int corner : {0, 1, 2, 2, 1, 3}) {
                const int right = corner & 1, low = corner >> 1;
                corners.push_back(float((pen + g.left + right * g.width) * scale));
                corners.push_back(float((-g.top + low * g.height) * scale));
                corners.push_back(float(g.x + right * g.width) / float(size_.width));
                corners.push_back(float(g.y + low * g.height) / float(size_.height));
            }
            pen += g.advance;
        }
        const Mat4 clip = clip_from_room * matrix(text.room_from_text);
        float values[16];
        for (std::size_t i = 0; i < 16; ++i)
            values[i] = float(clip.m[i]);
        glUniformMatrix4fv(program_.uniform("clip_from_text"), 1, GL_FALSE, values);
        glUniform3f(program_.uniform("color"), float(text.color.r) / 255, float(text.color.g) / 255,
                    float(text.color.b) / 255);
        glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(corners.size() * sizeof(float)), corners.data(),
                     GL_STREAM_DRAW);
        glDrawArrays(GL_TRIANGLES, 0, GLsizei(corners.size() / 4));
    }
    glBindVertexArray(0);
}

}  // namespace theatron::render
