// SPDX-License-Identifier: Apache-2.0
// Letters as distances to their outlines: sharp at any size. Native programs make it with a font
// library; a browser can fill it from a canvas.
#pragma once

#include <cstddef>
#include <map>
#include <span>

#include "image/image.h"

namespace theatron::render {

struct FontAtlas {
    struct Glyph {
        int x = 0, y = 0, width = 0, height = 0;  // in `distances`
        // From the pen to the glyph's upper left corner and to the next pen, in pixels.
        int left = 0, top = 0;
        double advance = 0;
    };
    Image<std::uint8_t> distances;  // 128 at the outline, more inside
    std::map<char32_t, Glyph> glyphs;
    double capital_height = 0;  // pixels
};

// Latin letters, digits and signs of a font, given as the bytes of its file. Takes some tenths
// of a second. Throws Error if it cannot be read. A browser draws the letters with its own font
// instead.
FontAtlas load_font_atlas(std::span<const std::byte> font);

}  // namespace theatron::render
