// SPDX-License-Identifier: Apache-2.0
#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <memory>

#include "base/error.h"
#include "render/font_atlas.h"

namespace theatron::render {
namespace {

constexpr int atlas_width = 1024, glyph_pixels = 40, gap = 2;
constexpr char32_t first = 0x20, last = 0x17f;

// Copies a glyph below or beside those that are there.
void place(FontAtlas& atlas, FontAtlas::Glyph& glyph, const FT_Bitmap& bitmap, int& x, int& y,
           int& row_height) {
    glyph.width = int(bitmap.width);
    glyph.height = int(bitmap.rows);
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
        std::copy_n(bitmap.buffer + r * bitmap.pitch, glyph.width,
                    atlas.distances.view().row(glyph.y + r) + glyph.x);
}

}  // namespace

FontAtlas load_font_atlas(const std::string& file) {
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library) != 0)
        throw Error("The font library does not start.");
    const std::unique_ptr<FT_LibraryRec_, decltype(&FT_Done_FreeType)> owner(library,
                                                                             FT_Done_FreeType);
    FT_Face face = nullptr;
    if (FT_New_Face(library, file.c_str(), 0, &face) != 0)
        throw Error("Cannot read the font " + file + ".");
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
        // Distances from a drawn glyph: from its outline they take far longer.
        if (FT_Render_Glyph(face->glyph, FT_RENDER_MODE_NORMAL) == 0 &&
            FT_Render_Glyph(face->glyph, FT_RENDER_MODE_SDF) == 0 && face->glyph->bitmap.buffer) {
            glyph.left = face->glyph->bitmap_left;
            glyph.top = face->glyph->bitmap_top;
            place(atlas, glyph, face->glyph->bitmap, x, y, row_height);
        }
        atlas.glyphs[letter] = glyph;
    }
    atlas.capital_height = 0.73 * glyph_pixels;
    FT_Done_Face(face);
    return atlas;
}

}  // namespace theatron::render
