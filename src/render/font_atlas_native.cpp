// SPDX-License-Identifier: Apache-2.0
#include <ft2build.h>
#include FT_FREETYPE_H

#include <memory>

#include "base/error.h"
#include "render/glyphs.h"

namespace theatron::render {

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

    GlyphCollector collector;
    for (char32_t letter = first_glyph; letter <= last_glyph; ++letter) {
        if (!is_in_atlas(letter) || FT_Load_Char(face, letter, FT_LOAD_DEFAULT) != 0)
            continue;
        auto* const slot = face->glyph;
        const double advance = double(slot->advance.x) / 64;
        if (FT_Render_Glyph(slot, FT_RENDER_MODE_NORMAL) != 0 || !slot->bitmap.buffer) {
            collector.add(letter, advance);
            continue;
        }
        const FT_Bitmap& bitmap = slot->bitmap;
        collector.add(letter, advance,
                      {bitmap.buffer, {int(bitmap.width), int(bitmap.rows)}, bitmap.pitch},
                      slot->bitmap_left, slot->bitmap_top);
    }
    FT_Done_Face(face);
    return collector.take(0.73 * glyph_pixels);
}

}  // namespace theatron::render
