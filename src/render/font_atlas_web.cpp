// SPDX-License-Identifier: Apache-2.0
// The browser draws the letters, with the font that it uses for pages.
#include "render/font_atlas_web.h"

#include <emscripten.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "render/glyphs.h"

// clang-format off
// Draws a letter with its pen at (x, y) into `covered`, side * side bytes. Returns its advance.
EM_JS(double, theatron_draw_letter, (int letter, int pixels, int side, int x, int y, std::uint8_t* covered), {
    if (!Module.letterCanvas) {
        const canvas = document.createElement("canvas");
        canvas.width = canvas.height = side;
        Module.letterCanvas = canvas.getContext("2d", {willReadFrequently: true});
    }
    const context = Module.letterCanvas;
    context.font = pixels + 'px "DejaVu Sans", Verdana, sans-serif';
    context.clearRect(0, 0, side, side);
    const text = String.fromCodePoint(letter);
    context.fillText(text, x, y);
    const drawn = context.getImageData(0, 0, side, side).data;
    for (let i = 0; i < side * side; ++i)
        HEAPU8[covered + i] = drawn[4 * i + 3];
    return context.measureText(text).width;
});
// clang-format on

namespace theatron::render {
namespace {

constexpr int cell = 2 * glyph_pixels;  // of a canvas that holds any letter
constexpr int pen_x = glyph_pixels / 2, base_line = cell - glyph_pixels / 2;

// A step of this number of letters takes some milliseconds.
constexpr int letters_at_once = 4;

class Letters {
public:
    // False once all are there.
    bool step() {
        for (int drawn = 0; drawn < letters_at_once && next_ <= last_glyph; ++next_)
            if (is_in_atlas(next_)) {
                add(next_);
                ++drawn;
            }
        if (next_ <= last_glyph)
            return true;
        if (!atlas_)
            atlas_ = collector_.take(0.73 * glyph_pixels);
        return false;
    }
    const FontAtlas& atlas() const { return *atlas_; }

private:
    void add(char32_t letter) {
        const double advance = theatron_draw_letter(int(letter), glyph_pixels, cell, pen_x,
                                                    base_line, covered_.data());
        int left = cell, right = 0, top = cell, bottom = 0;
        for (int y = 0; y < cell; ++y)
            for (int x = 0; x < cell; ++x)
                if (covered_[std::size_t(y * cell + x)] != 0) {
                    left = std::min(left, x);
                    right = std::max(right, x + 1);
                    top = std::min(top, y);
                    bottom = std::max(bottom, y + 1);
                }
        if (left >= right)
            return collector_.add(letter, advance);
        collector_.add(letter, advance,
                       {covered_.data() + top * cell + left, {right - left, bottom - top}, cell},
                       left - pen_x, base_line - top);
    }

    char32_t next_ = first_glyph;
    GlyphCollector collector_;
    std::vector<std::uint8_t> covered_ = std::vector<std::uint8_t>(std::size_t(cell) * cell);
    std::optional<FontAtlas> atlas_;
};

Letters& letters() {
    static Letters only;
    return only;
}

}  // namespace

bool prepare_font_atlas() {
    return !letters().step();
}

FontAtlas load_font_atlas(std::span<const std::byte>) {
    while (letters().step()) {
    }
    return letters().atlas();
}

}  // namespace theatron::render
