// SPDX-License-Identifier: Apache-2.0
// A font atlas from drawn letters, whoever draws them.
#pragma once

#include "image/view.h"
#include "render/font_atlas.h"

namespace theatron::render {

// Height of the letters that are drawn for the atlas, pixels of an em.
inline constexpr int glyph_pixels = 40;
// In place of letters that the atlas lacks: a hollow box.
inline constexpr char32_t unknown_glyph = 0x25a1;
// The letters of an atlas: Latin, Greek and Cyrillic.
inline constexpr char32_t first_glyph = 0x20, last_glyph = unknown_glyph;
constexpr bool is_in_atlas(char32_t letter) {
    return (letter >= first_glyph && letter < 0x180 && (letter < 0x7f || letter >= 0xa0)) ||
           (letter >= 0x384 && letter < 0x3cf) || (letter >= 0x400 && letter < 0x460) ||
           letter == unknown_glyph;
}

// Makes an atlas of letters.
class GlyphCollector {
public:
    GlyphCollector();

    // A letter without a picture, such as a space.
    void add(char32_t letter, double advance);
    // `covered`: 255 inside of the letter, grey at its outline. Its upper left corner is `left`
    // right of the pen and `top` above the base line.
    void add(char32_t letter, double advance, View<const std::uint8_t> covered, int left, int top);

    FontAtlas take(double capital_height);

private:
    FontAtlas atlas_;
    int x_ = 0, y_ = 0, row_height_ = 0;
};

}  // namespace theatron::render
