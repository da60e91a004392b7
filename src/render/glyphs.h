// SPDX-License-Identifier: Apache-2.0
// A font atlas from drawn letters, whoever draws them.
#pragma once

#include "image/view.h"
#include "render/font_atlas.h"

namespace theatron::render {

// Height of the letters that are drawn for the atlas, pixels of an em.
inline constexpr int glyph_pixels = 40;
// The letters of an atlas.
inline constexpr char32_t first_glyph = 0x20, last_glyph = 0x17f;
constexpr bool is_in_atlas(char32_t letter) {
    return letter >= first_glyph && letter <= last_glyph && (letter < 0x7f || letter >= 0xa0);
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
