// SPDX-License-Identifier: Apache-2.0
#include "window/text_picture_native.h"

#include <algorithm>
#include <cmath>

#include "base/utf8.h"
#include "render/glyphs.h"

namespace theatron::window {
namespace {

using render::FontAtlas;

// Calls `each(glyph, pen)` for each letter that the font has, in pixels of the font. Returns where
// the pen is at the end.
template <class Each>
double for_each_glyph(const FontAtlas& font, std::string_view utf8, const Each& each) {
    double pen = 0;
    while (!utf8.empty()) {
        const Utf8Character letter = first_character(utf8);
        utf8.remove_prefix(letter.bytes);
        auto known = font.glyphs.find(letter.code);
        if (known == font.glyphs.end())
            known = font.glyphs.find(render::unknown_glyph);
        if (known == font.glyphs.end())
            continue;
        each(known->second, pen);
        pen += known->second.advance;
    }
    return pen;
}

// The distance at a place between pixels; 0, far outside, beyond the glyph.
double distance_at(const FontAtlas& font, const FontAtlas::Glyph& glyph, double x, double y) {
    const int left = int(std::floor(x)), top = int(std::floor(y));
    const auto at = [&](int column, int row) {
        const bool is_inside =
            column >= 0 && row >= 0 && column < glyph.width && row < glyph.height;
        return is_inside ? double(font.distances.view().row(glyph.y + row)[glyph.x + column]) : 0.0;
    };
    const double right_part = x - left, low_part = y - top;
    const auto row = [&](int r) {
        return at(left, r) * (1 - right_part) + at(left + 1, r) * right_part;
    };
    return row(top) * (1 - low_part) + row(top + 1) * low_part;
}

std::uint8_t mixed(std::uint8_t ground, std::uint8_t ink, double share) {
    return std::uint8_t(std::lround(ground + (ink - ground) * share));
}

}  // namespace

double text_width(const FontAtlas& font, std::string_view utf8, double capital_pixels) {
    return for_each_glyph(font, utf8, [](const auto&, double) {}) * capital_pixels /
           font.capital_height;
}

ColorImage text_picture(const FontAtlas& font, std::string_view utf8, double capital_pixels,
                        Rgb ink, Rgb ground) {
    constexpr double outline = 128, softness = 24;  // of the distances
    const double scale = capital_pixels / font.capital_height;
    const double margin = capital_pixels;
    ColorImage picture({int(std::ceil(text_width(font, utf8, capital_pixels) + 2 * margin)),
                        int(std::ceil(3 * margin))});
    std::fill(picture.pixels.begin(), picture.pixels.end(), ground);
    const double base_line = 2 * margin;
    for_each_glyph(font, utf8, [&](const FontAtlas::Glyph& glyph, double pen) {
        const double left = margin + (pen + glyph.left) * scale;
        const double top = base_line - glyph.top * scale;
        const int last_x = std::min(picture.size.width - 1, int(left + glyph.width * scale));
        const int last_y = std::min(picture.size.height - 1, int(top + glyph.height * scale));
        for (int y = std::max(0, int(top)); y <= last_y; ++y)
            for (int x = std::max(0, int(left)); x <= last_x; ++x) {
                const double distance = distance_at(font, glyph, (x + 0.5 - left) / scale - 0.5,
                                                    (y + 0.5 - top) / scale - 0.5);
                const double share =
                    std::clamp(0.5 + (distance - outline) / (2 * softness), 0.0, 1.0);
                Rgb& pixel = picture.view().row(y)[x];
                pixel = {mixed(pixel.r, ink.r, share), mixed(pixel.g, ink.g, share),
                         mixed(pixel.b, ink.b, share)};
            }
    });
    return picture;
}

}  // namespace theatron::window
