// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "study/bricks.h"

namespace theatron::study {
namespace {

// Sizes of common interlocking bricks, in millimetres.
constexpr int stud_mm = 8;
constexpr double layer_mm = 9.6, stud_radius_mm = 2.4, stud_height_mm = 1.7;
constexpr int page_width_mm = 210, page_height_mm = 297, margin_mm = 12, gap_mm = 6;
constexpr int shown_studs = 10;  // across a layer's drawing
constexpr double quarter_turn = 1.5707963267948966;

std::string escaped(const std::string& text) {
    std::string safe;
    for (const char c : text)
        safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return safe;
}

// Tenths and hundredths, without the locale of the process.
std::string decimal(double value) {
    const long hundredths = std::lround(value * 100);
    const long size = std::labs(hundredths);
    const std::string part = std::to_string(size % 100);
    return (hundredths < 0 ? "-" : "") + std::to_string(size / 100) + "." +
           (part.size() < 2 ? "0" : "") + part;
}

std::string text_at(double x, double y, const std::string& text, const char* size) {
    return "<text x='" + decimal(x) + "' y='" + decimal(y) + "' font-size='" + size + "'>" +
           escaped(text) + "</text>\n";
}

std::string rectangle(double x, double y, double width, double height, const std::string& look) {
    return "<rect x='" + decimal(x) + "' y='" + decimal(y) + "' width='" + decimal(width) +
           "' height='" + decimal(height) + "' " + look + "/>\n";
}

// The letter of a colour, for prints in grey: "R", black "K".
std::string letter_of(BrickColor color) {
    return color == BrickColor::black ? "K" : std::string(1, char(name_of(color)[0] - 'a' + 'A'));
}

// Nothing is below it: it holds by the layer above alone.
bool hangs(const Brick& brick, const Construction& construction) {
    return brick.layer > 0 && std::none_of(construction.bricks.begin(), construction.bricks.end(),
                                           [&](const Brick& other) {
                                               return other.layer == brick.layer - 1 &&
                                                      overlaps(brick, other);
                                           });
}

std::string drawn(const Brick& brick, bool hangs, double x, double y, double scale) {
    const double pitch = stud_mm * scale;
    std::string svg = rectangle(
        x + brick.x * pitch, y + brick.y * pitch, brick.width * pitch, brick.depth * pitch,
        std::string("fill='") + code_of(brick.color) + "' stroke='#000' stroke-width='0.4'");
    const bool is_dark = brick.color != BrickColor::white && brick.color != BrickColor::yellow;
    for (int i = 0; i < brick.width * brick.depth; ++i) {
        const double cx = x + (brick.x + i % brick.width + 0.5) * pitch;
        const double cy = y + (brick.y + i / brick.width + 0.5) * pitch;
        svg += "<circle cx='" + decimal(cx) + "' cy='" + decimal(cy) + "' r='" +
               decimal(stud_radius_mm * scale) + "' fill='none' stroke='" +
               (is_dark ? "#fff" : "#000") + "' stroke-width='0.2'/>\n";
    }
    svg += "<text x='" + decimal(x + (brick.x + brick.width / 2.0) * pitch) + "' y='" +
           decimal(y + (brick.y + brick.depth / 2.0) * pitch + 1.5 * scale) +
           "' font-size='4' font-weight='bold' text-anchor='middle' fill='" +
           (is_dark ? "#fff" : "#000") + "'>" + letter_of(brick.color) + (hangs ? "^" : "") +
           "</text>\n";
    return svg;
}

// Corners and faces of one closed surface after the other.
class ObjWriter {
public:
    // A prism that stands upright; its outline goes around against the clock, seen from above.
    template <std::size_t n>
    void add_prism(const std::array<std::array<double, 2>, n>& outline, double bottom, double top) {
        for (const double z : {bottom, top})
            for (const auto& [x, y] : outline)
                corners_ += "v " + decimal(x) + " " + decimal(y) + " " + decimal(z) + "\n";
        const std::size_t low = next_, high = next_ + n;
        for (std::size_t i = 1; i + 1 < n; ++i) {
            add(low, low + i + 1, low + i);
            add(high, high + i, high + i + 1);
        }
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t j = (i + 1) % n;
            add(low + i, low + j, high + j);
            add(low + i, high + j, high + i);
        }
        next_ += 2 * n;
    }
    bool is_empty() const { return faces_.empty(); }
    std::string text() const { return corners_ + faces_; }

private:
    void add(std::size_t a, std::size_t b, std::size_t c) {
        faces_ +=
            "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
    }
    std::size_t next_ = 1;
    std::string corners_, faces_;
};

}  // namespace

std::string construction_text(const Construction& construction) {
    std::string text;
    for (const Brick& brick : construction.bricks)
        text +=
            "layer " + std::to_string(brick.layer + 1) + ": " + kind_of(brick) + " at " +
            std::to_string(brick.x) + "," + std::to_string(brick.y) + ", " +
            std::to_string(brick.width) + " wide and " + std::to_string(brick.depth) + " deep" +
            (hangs(brick, construction) ? ", hangs from layer " + std::to_string(brick.layer + 2)
                                        : "") +
            "\n";
    return text;
}

std::string construction_plan(const Construction& construction, const std::string& title) {
    std::map<int, std::vector<Brick>> by_layer;
    std::map<std::string, int> kinds;
    for (const Brick& brick : construction.bricks) {
        by_layer[brick.layer].push_back(brick);
        ++kinds[kind_of(brick)];
    }
    int low_x = 1000, low_y = 1000, high_x = 0, high_y = 0;
    for (const Brick& brick : construction.bricks) {
        low_x = std::min(low_x, brick.x);
        low_y = std::min(low_y, brick.y);
        high_x = std::max(high_x, brick.x + brick.width);
        high_y = std::max(high_y, brick.y + brick.depth);
    }
    // Two layers side by side. A large construction is drawn smaller.
    const int across = std::max(high_x - low_x, 1), down = std::max(high_y - low_y, 1);
    const double rows = double((by_layer.size() + 1) / 2);
    const double free_mm = page_height_mm - 78.0 - rows * (gap_mm + 4);
    const double shown_scale =
        std::min({1.0, double(shown_studs) / across, free_mm / (rows * down * stud_mm)});
    const double cell_width = across * stud_mm * shown_scale;
    const double cell_height = down * stud_mm * shown_scale;
    std::string svg =
        "<svg xmlns='http://www.w3.org/2000/svg' width='210mm' height='297mm' "
        "viewBox='0 0 210 297' font-family='sans-serif'>\n";
    svg += rectangle(0, 0, page_width_mm, page_height_mm, "fill='#fff'");
    svg += text_at(margin_mm, margin_mm + 4, title, "6");
    svg += text_at(margin_mm, margin_mm + 10,
                   shown_scale > 0.999
                       ? "Layers from above, the lowest first; print at 100 %: a stud is 8 mm."
                       : "Layers from above, the lowest first; drawn smaller than the bricks.",
                   "3.5");
    svg += text_at(
        margin_mm, margin_mm + 15,
        "Grey outlines: the layer below. R red, B blue, Y yellow, G green, W white, K black.",
        "3.5");
    if (std::any_of(construction.bricks.begin(), construction.bricks.end(),
                    [&](const Brick& brick) { return hangs(brick, construction); }))
        svg += text_at(margin_mm, margin_mm + 19,
                       "^ has no brick below it: put it under its brick of the next layer first.",
                       "3.5");
    int place = 0;
    double bottom = margin_mm + 23;
    for (const auto& [layer, bricks] : by_layer) {
        const double x = margin_mm + place % 2 * (cell_width + 3 * gap_mm);
        const double y = margin_mm + 27 + place / 2 * (cell_height + gap_mm + 4);
        svg += text_at(x, y - 1.5, "Layer " + std::to_string(layer + 1), "3.5");
        svg += rectangle(x, y, cell_width, cell_height,
                         "fill='none' stroke='#bbb' stroke-width='0.2'");
        const double pitch = stud_mm * shown_scale;
        const double left = x - low_x * pitch, top = y - low_y * pitch;
        for (const Brick& brick : bricks)
            svg += drawn(brick, hangs(brick, construction), left, top, shown_scale);
        if (const auto below = by_layer.find(layer - 1); below != by_layer.end())
            for (const Brick& brick : below->second)
                svg += rectangle(left + brick.x * pitch, top + brick.y * pitch, brick.width * pitch,
                                 brick.depth * pitch,
                                 "fill='none' stroke='#888' stroke-width='0.5' "
                                 "stroke-dasharray='1.5 1'");
        bottom = y + cell_height + gap_mm;
        ++place;
    }
    int line = 0;
    for (const auto& [kind, count] : kinds) {
        svg += text_at(margin_mm + line % 3 * 62.0, bottom + 4 + line / 3 * 5.0,
                       std::to_string(count) + " x " + kind, "3.5");
        ++line;
    }
    return svg + "</svg>\n";
}

std::string construction_obj(const Construction& construction, BrickColor color) {
    ObjWriter obj;
    for (const Brick& brick : construction.bricks) {
        if (brick.color != color)
            continue;
        // A small play, so that bricks side by side do not share their faces.
        constexpr double play_mm = 0.1;
        // The plan is seen from above and its y goes down; here z goes up, so y goes the other way.
        const double x0 = brick.x * stud_mm + play_mm;
        const double x1 = (brick.x + brick.width) * stud_mm - play_mm;
        const double y0 = -(brick.y + brick.depth) * stud_mm + play_mm;
        const double y1 = -brick.y * stud_mm - play_mm;
        const double bottom = brick.layer * layer_mm, top = bottom + layer_mm;
        obj.add_prism<4>({{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}, bottom, top);
        for (int i = 0; i < brick.width * brick.depth; ++i) {
            std::array<std::array<double, 2>, 8> around{};
            for (std::size_t k = 0; k < around.size(); ++k) {
                const double angle = double(k) * quarter_turn / 2;
                around[k] = {
                    (brick.x + i % brick.width + 0.5) * stud_mm + stud_radius_mm * std::cos(angle),
                    -(brick.y + i / brick.width + 0.5) * stud_mm +
                        stud_radius_mm * std::sin(angle)};
            }
            obj.add_prism<8>(around, top, top + stud_height_mm);
        }
    }
    return obj.is_empty() ? "" : "# millimetres, z up\n" + obj.text();
}

}  // namespace theatron::study
