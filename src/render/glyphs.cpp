// SPDX-License-Identifier: Apache-2.0
#include "render/glyphs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace theatron::render {
namespace {

constexpr int atlas_width = 1024, gap = 2;

// How far outlines are followed to either side, in pixels.
constexpr int spread = 5;

// Distances from a drawn glyph, which has grey pixels at its outline.
Image<std::uint8_t> distances_of(View<const std::uint8_t> drawn) {
    constexpr int side = 2 * spread + 1;
    static const auto lengths = [] {
        std::array<double, std::size_t(side) * side> all{};
        for (int dy = -spread; dy <= spread; ++dy)
            for (int dx = -spread; dx <= spread; ++dx)
                all[std::size_t((dy + spread) * side + dx + spread)] = std::hypot(dx, dy);
        return all;
    }();
    const int width = drawn.size.width, height = drawn.size.height;
    Image<std::uint8_t> result({width + 2 * spread, height + 2 * spread});
    const auto covered = [&](int x, int y) {
        return x < 0 || y < 0 || x >= width || y >= height ? 0.0 : drawn.row(y)[x] / 255.0;
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
                            nearest, lengths[std::size_t((dy + spread) * side + dx + spread)] +
                                         (inside ? there - 0.5 : 0.5 - there));
                }
            const double distance = inside ? nearest : -nearest;
            result.view().row(y)[x] =
                std::uint8_t(std::clamp(128 + 127 * distance / spread, 0.0, 255.0));
        }
    return result;
}

}  // namespace

GlyphCollector::GlyphCollector() {
    atlas_.distances.resize({atlas_width, 1});
}

void GlyphCollector::add(char32_t letter, double advance) {
    atlas_.glyphs[letter].advance = advance;
}

// Copies the glyph below or beside those that are there.
void GlyphCollector::add(char32_t letter, double advance, View<const std::uint8_t> covered,
                         int left, int top) {
    const Image<std::uint8_t> picture = distances_of(covered);
    FontAtlas::Glyph glyph;
    glyph.advance = advance;
    glyph.left = left - spread;
    glyph.top = top + spread;
    glyph.width = picture.size.width;
    glyph.height = picture.size.height;
    if (x_ + glyph.width + gap > atlas_width) {
        x_ = 0;
        y_ += row_height_ + gap;
        row_height_ = 0;
    }
    glyph.x = x_;
    glyph.y = y_;
    x_ += glyph.width + gap;
    row_height_ = std::max(row_height_, glyph.height);
    atlas_.distances.resize(
        {atlas_width, std::max(atlas_.distances.size.height, y_ + row_height_)});
    for (int r = 0; r < glyph.height; ++r)
        std::copy_n(picture.view().row(r), glyph.width,
                    atlas_.distances.view().row(glyph.y + r) + glyph.x);
    atlas_.glyphs[letter] = glyph;
}

FontAtlas GlyphCollector::take(double capital_height) {
    atlas_.capital_height = capital_height;
    return std::move(atlas_);
}

}  // namespace theatron::render
