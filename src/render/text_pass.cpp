// SPDX-License-Identifier: Apache-2.0
#include "render/text_pass.h"

#include "base/utf8.h"
#include "render/glyphs.h"

namespace theatron::render {
namespace {

constexpr int atlas_unit = 2;
// In place of a letter that the atlas lacks, in heights of a capital letter.
constexpr double missing_width = 0.5;

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

const FontAtlas::Glyph* TextPass::glyph_of(char32_t letter) const {
    auto known = atlas_.glyphs.find(letter);
    if (known == atlas_.glyphs.end())
        known = atlas_.glyphs.find(unknown_glyph);
    return known == atlas_.glyphs.end() ? nullptr : &known->second;
}

double TextPass::length_of(std::string_view utf8) const {
    double pixels = 0;
    while (!utf8.empty()) {
        const Utf8Character letter = first_character(utf8);
        utf8.remove_prefix(letter.bytes);
        const FontAtlas::Glyph* glyph = glyph_of(letter.code);
        pixels += glyph ? glyph->advance : missing_width * atlas_.capital_height;
    }
    return pixels / atlas_.capital_height;
}

void TextPass::draw_line(std::string_view utf8, const Mat4& clip_from_text, double height,
                         Rgb color) {
    program_.use();
    glActiveTexture(GL_TEXTURE0 + atlas_unit);
    glBindTexture(GL_TEXTURE_2D, distances_.name());
    glBindVertexArray(attributes_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    const double scale = height / atlas_.capital_height;
    std::vector<float> corners;
    double pen = 0;
    while (!utf8.empty()) {
        const Utf8Character letter = first_character(utf8);
        utf8.remove_prefix(letter.bytes);
        const FontAtlas::Glyph* glyph = glyph_of(letter.code);
        if (!glyph) {
            pen += missing_width * atlas_.capital_height;
            continue;
        }
        const FontAtlas::Glyph& g = *glyph;
        for (const int corner : {0, 1, 2, 2, 1, 3}) {
            const int right = corner & 1, low = corner >> 1;
            corners.push_back(float((pen + g.left + right * g.width) * scale));
            corners.push_back(float((-g.top + low * g.height) * scale));
            corners.push_back(float(g.x + right * g.width) / float(size_.width));
            corners.push_back(float(g.y + low * g.height) / float(size_.height));
        }
        pen += g.advance;
    }
    set_matrix(clip_from_text_, clip_from_text);
    glUniform3f(color_, float(color.r) / 255, float(color.g) / 255, float(color.b) / 255);
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(corners.size() * sizeof(float)), corners.data(),
                 GL_STREAM_DRAW);
    glDrawArrays(GL_TRIANGLES, 0, GLsizei(corners.size() / 4));
}

void TextPass::draw(const std::vector<SceneText>& texts, const CameraView& view) {
    const Mat4 clip_from_room = projection(view) * matrix(inverse(view.room_from_eye));
    for (const SceneText& text : texts)
        draw_line(text.utf8, clip_from_room * matrix(text.room_from_text), text.height_m,
                  text.color);
    glBindVertexArray(0);
}

}  // namespace theatron::render
