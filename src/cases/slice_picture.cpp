// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string_view>

#include "cases/case_pictures.h"
#include "medical/mesh_cut.h"

namespace theatron::cases {
namespace {

using medical::SlicePlane;

constexpr Rgb ink{255, 220, 90};
constexpr int glyph_scale = 2, margin = 6;

// Five columns by seven rows, the leftmost column in the highest bit.
struct Glyph {
    char letter;
    unsigned char rows[7];
};
constexpr Glyph glyphs[] = {
    {'R', {30, 17, 17, 30, 20, 18, 17}}, {'L', {16, 16, 16, 16, 16, 16, 31}},
    {'A', {14, 17, 17, 31, 17, 17, 17}}, {'P', {30, 17, 17, 30, 16, 16, 16}},
    {'H', {17, 17, 17, 31, 17, 17, 17}}, {'F', {31, 16, 16, 30, 16, 16, 16}}};

void put(ColorImage& image, int x, int y, Rgb color) {
    if (x >= 0 && y >= 0 && x < image.size.width && y < image.size.height)
        image.view().row(y)[x] = color;
}

int text_width(std::string_view text) {
    return int(text.size()) * 6 * glyph_scale;
}

void draw_text(ColorImage& image, int x, int y, std::string_view text) {
    for (const char letter : text) {
        for (const Glyph& glyph : glyphs)
            if (glyph.letter == letter)
                for (int i = 0; i < 7 * 5 * glyph_scale * glyph_scale; ++i) {
                    const int column = i % (5 * glyph_scale), row = i / (5 * glyph_scale);
                    if (glyph.rows[row / glyph_scale] >> (4 - column / glyph_scale) & 1)
                        put(image, x + column, y + row, ink);
                }
        x += 6 * glyph_scale;
    }
}

void draw_line(ColorImage& image, Vec2 a, Vec2 b, Rgb color) {
    const int steps = int(std::ceil(2 * std::max({std::abs(b.x - a.x), std::abs(b.y - a.y), 0.5})));
    for (int i = 0; i <= steps; ++i) {
        const double t = double(i) / steps;
        put(image, int(std::floor(a.x + (b.x - a.x) * t + 0.5)),
            int(std::floor(a.y + (b.y - a.y) * t + 0.5)), color);
    }
}

void draw_letters(ColorImage& image, const SlicePlane& plane) {
    const medical::EdgeLetters letters = medical::edge_letters(plane);
    const int middle_x = image.size.width / 2, middle_y = image.size.height / 2;
    const int height = 7 * glyph_scale;
    draw_text(image, margin, middle_y - height / 2, letters.left);
    draw_text(image, image.size.width - margin - text_width(letters.right), middle_y - height / 2,
              letters.right);
    draw_text(image, middle_x - text_width(letters.top) / 2, margin, letters.top);
    draw_text(image, middle_x - text_width(letters.bottom) / 2, image.size.height - margin - height,
              letters.bottom);
}

void draw_scale_bar(ColorImage& image, const SlicePlane& plane) {
    const medical::ScaleBar bar = medical::scale_bar(plane.mm_per_pixel, image.size.width / 4.0);
    const int y = image.size.height - 2 * margin, x = margin, end = x + int(bar.pixels + 0.5);
    for (int i = x; i <= end; ++i)
        put(image, i, y, ink);
    for (int tick = -4; tick <= 4; ++tick) {
        put(image, x, y + tick, ink);
        put(image, end, y + tick, ink);
    }
}

}  // namespace

ColorImage picture_of_slice(const LoadedCase& loaded, std::size_t series, const SlicePlane& plane,
                            medical::Window window) {
    const medical::Volume& volume = loaded.volumes.at(series);
    Image<std::int16_t> slice(plane.size);
    const auto lowest = std::int16_t(volume.slope > 0 ? -32768 : 32767);
    medical::reslice(volume, plane, lowest, slice.view());
    const medical::GreyTable greys(window, volume);
    ColorImage picture(plane.size);
    for (std::size_t i = 0; i < slice.pixels.size(); ++i) {
        const std::uint8_t grey = greys[slice.pixels[i]];
        picture.pixels[i] = {grey, grey, grey};
    }
    for (std::size_t i = 0; i < loaded.meshes.size(); ++i) {
        const medical::Part& part = loaded.manifest.parts[i];
        if (part.opacity == 0)
            continue;
        for (const medical::Segment& s :
             medical::cut_mesh(loaded.meshes[i], plane.top_left_mm, plane.normal()))
            draw_line(picture, pixel_of(plane, s.a), pixel_of(plane, s.b), part.color);
    }
    draw_letters(picture, plane);
    draw_scale_bar(picture, plane);
    return picture;
}

}  // namespace theatron::cases
