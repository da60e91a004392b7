// SPDX-License-Identifier: Apache-2.0
#include "synthetic/picture.h"

#include <array>

namespace theatron::synthetic {
namespace {

// Strokes of a simple capital alphabet on a grid of 4 by 6: pairs of digits are points, '-'
// lifts the pen.
struct Glyph {
    char letter;
    const char* strokes;
};
constexpr Glyph glyphs[] = {{'A', "062046-1434"},
                            {'B', "000636452403-0030413203"},
                            {'C', "4130100105163645"},
                            {'D', "00062645413000"},
                            {'E', "40000646-0333"},
                            {'F', "400006-0333"},
                            {'G', "413010010516364543 23"},
                            {'H', "0006-4046-0343"},
                            {'I', "1030-1636-2026"},
                            {'J', "2040-30352606 05"},
                            {'K', "0006-4003-1346"},
                            {'L', "000646"},
                            {'M', "0600234046"},
                            {'N', "06004640"},
                            {'O', "10010516364541301 0"},
                            {'P', "0600304142330 3"},
                            {'Q', "101105163645413010-2446"},
                            {'R', "0600304142330 3-2346"},
                            {'S', "4130100112334445361605"},
                            {'T', "0040-2026"},
                            {'U', "000516364540"},
                            {'V', "002640"},
                            {'W', "0016233640"},
                            {'X', "0046-4006"},
                            {'Y', "002340-2326"},
                            {'Z', "00400646"},
                            {'0', "1001051636454130 10-3214"},
                            {'1', "112026-1636"},
                            {'2', "011030414206 46"},
                            {'3', "0130414233-1333444536160 5"},
                            {'4', "36300444"},
                            {'5', "400002324345361605"},
                            {'6', "4130100105163645443303"},
                            {'7', "004016"},
                            {'8', "101102133344453616050413-33424130 10"},
                            {'9', "0516364541301001021343"},
                            {'-', "1333"},
                            {'.', "2526"},
                            {':', "2122-2425"},
                            {'/', "0640"},
                            {'%', "0640-0001-4546"},
                            {'+', "1333-2224"}};

const char* strokes_of(char letter) {
    for (const Glyph& g : glyphs)
        if (g.letter == letter)
            return g.strokes;
    return "";
}

std::uint8_t srgb_from_linear(float v) {
    const float s = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
    return std::uint8_t(std::lround(255 * clamp01(s)));
}

}  // namespace

float linear_from_srgb(std::uint8_t value) {
    static const auto table = [] {
        std::array<float, 256> t{};
        for (int i = 0; i < 256; ++i) {
            const float s = float(i) / 255;
            t[std::size_t(i)] = s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
        }
        return t;
    }();
    return table[value];
}

Picture::Picture(ColorImage image) {
    levels_.push_back(std::move(image));
    while (levels_.back().size.width > 1 && levels_.back().size.height > 1) {
        const ColorImage& fine = levels_.back();
        ColorImage half({fine.size.width / 2, fine.size.height / 2});
        for (int y = 0; y < half.size.height; ++y)
            for (int x = 0; x < half.size.width; ++x) {
                const Rgb* upper = fine.view().row(2 * y) + 2 * x;
                const Rgb* lower = fine.view().row(2 * y + 1) + 2 * x;
                const auto mean = [&](std::uint8_t Rgb::*c) {
                    return srgb_from_linear(
                        (linear_from_srgb(upper[0].*c) + linear_from_srgb(upper[1].*c) +
                         linear_from_srgb(lower[0].*c) + linear_from_srgb(lower[1].*c)) /
                        4);
                };
                half.view().row(y)[x] = {mean(&Rgb::r), mean(&Rgb::g), mean(&Rgb::b)};
            }
        levels_.push_back(std::move(half));
    }
}

F3 Picture::sample(float u, float v, float blur) const {
    const float wanted = std::log2(std::max(blur * float(levels_[0].size.width), 1.0f));
    const auto level = std::min(std::size_t(wanted + 0.3f), levels_.size() - 1);
    const ColorImage& image = levels_[level];
    const float x = clamp01(u) * float(image.size.width) - 0.5f;
    const float y = clamp01(v) * float(image.size.height) - 0.5f;
    const int x0 = std::clamp(int(std::floor(x)), 0, image.size.width - 1);
    const int y0 = std::clamp(int(std::floor(y)), 0, image.size.height - 1);
    const int x1 = std::min(x0 + 1, image.size.width - 1);
    const int y1 = std::min(y0 + 1, image.size.height - 1);
    const auto at = [&](int px, int py) {
        const Rgb c = image.view().row(py)[px];
        return F3{linear_from_srgb(c.r), linear_from_srgb(c.g), linear_from_srgb(c.b)};
    };
    const float fx = clamp01(x - float(x0)), fy = clamp01(y - float(y0));
    return mix(mix(at(x0, y0), at(x1, y0), fx), mix(at(x0, y1), at(x1, y1), fx), fy);
}

Canvas::Canvas(Size size, Rgb background) : image_(size) {
    std::fill(image_.pixels.begin(), image_.pixels.end(), background);
}

void Canvas::blend_pixel(int x, int y, Rgb color, float share) {
    if (x < 0 || y < 0 || x >= image_.size.width || y >= image_.size.height || share <= 0)
        return;
    Rgb& p = image_.view().row(y)[x];
    const auto mixed = [&](std::uint8_t a, std::uint8_t b) {
        return std::uint8_t(float(a) + (float(b) - float(a)) * std::min(share, 1.0f) + 0.5f);
    };
    p = {mixed(p.r, color.r), mixed(p.g, color.g), mixed(p.b, color.b)};
}

void Canvas::rectangle(float x0, float y0, float x1, float y1, Rgb color) {
    for (int y = int(y0); y < int(y1); ++y)
        for (int x = int(x0); x < int(x1); ++x)
            blend_pixel(x, y, color, 1);
}

void Canvas::line(float x0, float y0, float x1, float y1, float width, Rgb color) {
    const float r = width / 2 + 1;
    const float dx = x1 - x0, dy = y1 - y0, l2 = std::max(dx * dx + dy * dy, 1e-6f);
    for (int y = int(std::min(y0, y1) - r); y <= int(std::max(y0, y1) + r); ++y)
        for (int x = int(std::min(x0, x1) - r); x <= int(std::max(x0, x1) + r); ++x) {
            const float px = float(x) - x0, py = float(y) - y0;
            const float t = clamp01((px * dx + py * dy) / l2);
            blend_pixel(x, y, color, width / 2 + 0.5f - std::hypot(px - dx * t, py - dy * t));
        }
}

void Canvas::ellipse(float cx, float cy, float rx, float ry, float turn, Rgb color) {
    const float r = std::max(rx, ry) + 1, c = std::cos(turn), s = std::sin(turn);
    for (int y = int(cy - r); y <= int(cy + r); ++y)
        for (int x = int(cx - r); x <= int(cx + r); ++x) {
            const float px = float(x) - cx, py = float(y) - cy;
            const float k = std::hypot((px * c + py * s) / rx, (py * c - px * s) / ry);
            blend_pixel(x, y, color, (1 - k) * std::min(rx, ry) + 0.5f);
        }
}

float Canvas::text(float x, float y, float height, std::string_view text, Rgb color) {
    const float unit = height / 6, width = height * 0.13f;
    for (const char letter : text) {
        float px = -1, py = 0;
        const char* s = strokes_of(letter);
        while (*s) {
            if (*s == ' ') {
                ++s;
                continue;
            }
            if (*s == '-') {
                px = -1;
                ++s;
                continue;
            }
            const float nx = x + float(*s++ - '0') * unit;
            while (*s == ' ')
                ++s;
            if (!*s)
                break;
            const float ny = y + float(*s++ - '0') * unit;
            if (px >= 0)
                line(px, py, nx, ny, width, color);
            px = nx;
            py = ny;
        }
        x += unit * 5.6f;
    }
    return x;
}

}  // namespace theatron::synthetic
