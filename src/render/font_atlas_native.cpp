// SPDX-License-Identifier: Apache-2.0
#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "render/font_atlas.h"

namespace theatron::render {
namespace {

constexpr int atlas_width = 1024, glyph_pixels = 40, gap = 2;
constexpr char32_t first = 0x20, last = 0x17f;

// How far outlines are followed to either side, in pixels.
constexpr int spread = 5;

// Distances from a drawn glyph, which has grey pixels at its outline. The library's own method
// takes ten seconds for an alphabet.
Image<std::uint8_t> distances_of(const FT_Bitmap& bitmap) {
    const int width = int(bitmap.width), height = int(bitmap.rows);
    Image<std::uint8_t> result({width + 2 * spread, height + 2 * spread});
    const auto covered = [&](int x, int y) {
        return x < 0 || y < 0 || x >= width || y >= height
                   ? 0.0
                   : bitmap.buffer[y * bitmap.pitch + x] / 255.0;
    };
    for (int y = 0; y < result.size.height; ++y)
        for (int x = 0; x < result.size.width; ++x) {
            const int gx = x - spread, gy = y - spread;
            const bool inside = covered(gx, gy) > 0.5;
            double nearest = spread;
            for (int dy = -spread; dy <= spread; ++dy)
                for (int dx = -spread; dx <= spread; ++dx) {
                    const double there = covered(gx + dx, gy + dy);
                    // The outline passes through grey pixels, or between black and white.
                    if (inside ? there < 1 : there > 0)
                        nearest = std::min(
                            nearest, std::hypot(dx, dy) + (inside ? there - 0.5 : 0.5 - there));
                }
            const double distance = inside ? nearest : -nearest;
            result.view().row(y)[x] =
                std::uint8_t(std::clamp(128 + 127 * distance / spread, 0.0, 255.0));
        }
    return result;
}

// Copies a glyph below or beside those that are there.
void place(FontAtlas& atlas, FontAtlas::Glyph& glyph, const Image<std::uint8_t>& picture, int& x,
           int& y, int& row_height) {
    glyph.width = picture.size.width;
    glyph.height = picture.size.height;
    if (x + glyph.width + gap > atlas_width) {
        x = 0;
        y += row_height + gap;
        row_height = 0;
    }
    glyph.x = x;
    glyph.y = y;
    x += glyph.width + gap;
    row_height = std::max(row_height, glyph.height);
    atlas.distances.resize({atlas_width, std::max(atlas.distances.size.height, y + row_height)});
    for (int r = 0; r < glyph.height; ++r)
        std::copy_n(picture.view().row(r), glyph.width,
                    atlas.distances.view().row(glyph.y + r) + glyph.x);
}

}  // namespace

FontAtlas load_font_atlas(std::span<const std::byte> font) {
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library) != 0)
        throw Error("The font library does not start.");
    const std::unique_ptr<FT_LibraryRec_, decltype(&FT_Done_FreeType)> owner(library,
                                                                             FT_Done_FreeType);
    FT_Face face = nullptr;
    if (FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(font.data()),
                           FT_Long(font.size()), 0, &face) != 0)
        throw Error("The font for texts in the room cannot be read.");
    FT_Set_Pixel_Sizes(face, 0, glyph_pixels);

    FontAtlas atlas;
    atlas.distances.resize({atlas_width, 1});
    int x = 0, y = 0, row_height = 0;
    for (char32_t letter = first; letter <= last; ++letter) {
        if (letter >= 0x7f && letter < 0xa0)
            continue;
        if (FT_Load_Char(face, letter, FT_LOAD_DEFAULT) != 0)
            continue;
        FontAtlas::Glyph glyph;
        glyph.advance = double(face->glyph->advance.x) / 64;
        auto* const slot = face->glyph;
        if (FT_Render_Glyph(slot, FT_RENDER_MODE_NORMAL) == 0 && slot->bitmap.buffer) {
            glyph.left = slot->bitmap_left - spread;
            glyph.top = slot->bitmap_top + spread;
            place(atlas, glyph, distances_of(slot->bitmap), x, y, row_height);
        }
        atlas.glyphs[letter] = glyph;
    }
    atlas.capital_height = 0.73 * glyph_pixels;
    FT_Done_Face(face);
    return atlas;
}

}  // namespace theatron::render
