// SPDX-License-Identifier: Apache-2.0
#include "bench_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

namespace theatron::bench {
namespace {

constexpr double panel_width = 560, panel_height = 420;
constexpr double left = 62, right = 24, top = 44, bottom = 52;
constexpr double letter_width = 6.3, line_height = 12;

std::string formatted(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof(text), format, value);
    return text;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        result += c == '&'   ? std::string("&amp;")
                  : c == '<' ? std::string("&lt;")
                             : std::string(1, c);
    return result;
}

// A logarithmic axis from values to positions, slightly longer than the range of values.
struct Axis {
    double low = 1, high = 10;  // values
    double from = 0, to = 1;    // positions

    double place(double value) const {
        return from + (to - from) * std::log(value / low) / std::log(high / low);
    }
    // 1, 2 and 5 times powers of ten; only powers of ten for long axes.
    std::vector<double> ticks() const {
        const bool many = high / low > 500;
        std::vector<double> result;
        for (int power = -3; power < 7; ++power)
            for (const double step : {1.0, 2.0, 5.0}) {
                const double tick = std::pow(10, power) * step;
                if (tick >= low && tick <= high && (!many || step == 1))
                    result.push_back(tick);
            }
        return result;
    }
};

Axis axis_of(const std::vector<double>& values, double from, double to) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return {*low / 1.25, *high * 1.25, from, to};
}

struct Box {
    double x, y, width, height;
    bool overlaps(const Box& other) const {
        return x < other.x + other.width && other.x < x + width && y < other.y + other.height &&
               other.y < y + height;
    }
};

class Plot {
public:
    void line(double x1, double y1, double x2, double y2, const char* color, double width) {
        svg_ += "<line x1='" + number(x1) + "' y1='" + number(y1) + "' x2='" + number(x2) +
                "' y2='" + number(y2) + "' stroke='" + color + "' stroke-width='" + number(width) +
                "'/>\n";
    }
    void circle(double x, double y, const char* color, bool filled) {
        svg_ += "<circle cx='" + number(x) + "' cy='" + number(y) + "' r='4' stroke='" + color +
                "' stroke-width='1.5' fill='" + (filled ? color : "#ffffff") + "'/>\n";
    }
    void text(double x, double y, const std::string& words, const char* anchor,
              const char* more = "") {
        svg_ += "<text x='" + number(x) + "' y='" + number(y) + "' text-anchor='" + anchor + "' " +
                more + ">" + escaped(words) + "</text>\n";
    }
    // Moves the origin for all following shapes.
    void begin_at(double x, double y) {
        svg_ += "<g transform='translate(" + number(x) + " " + number(y) + ")'>\n";
    }
    void end() { svg_ += "</g>\n"; }
    const std::string& svg() const { return svg_; }

private:
    static std::string number(double value) { return formatted("%.1f", value); }
    std::string svg_;
};

void draw_panel(Plot& out, const nlohmann::json& sequence) {
    std::vector<double> ms, kb;
    for (const auto& codec : sequence["codecs"]) {
        // Times below the clock's resolution are drawn at the edge.
        ms.push_back(std::max(codec["encode_ms"].get<double>(), 0.005));
        ms.push_back(std::max(codec["decode_ms"].get<double>(), 0.005));
        kb.push_back(codec["bytes_mean"].get<double>() / 1000);
    }
    const Axis x = axis_of(ms, left, panel_width - right);
    const Axis y = axis_of(kb, panel_height - bottom, top);

    for (const double tick : x.ticks()) {
        out.line(x.place(tick), top, x.place(tick), panel_height - bottom, "#e3e3e3", 1);
        out.text(x.place(tick), panel_height - bottom + 16, formatted("%g", tick), "middle");
    }
    for (const double tick : y.ticks()) {
        out.line(x.from, y.place(tick), x.to, y.place(tick), "#e3e3e3", 1);
        out.text(x.from - 6, y.place(tick) + 4, formatted("%g", tick), "end");
    }
    out.text(left, 20,
             sequence["sequence"].get<std::string>() + ", " +
                 std::to_string(sequence["frames"].get<int>()) + " frames",
             "start", "font-weight='bold'");
    out.text((x.from + x.to) / 2, panel_height - 16, "ms a frame, one thread", "middle");
    out.text(left, 36, "kB a frame; filled: encode, hollow: decode, orange: lossy", "start",
             "fill='#555555'");

    std::vector<Box> taken;
    for (std::size_t i = 0; i < kb.size(); ++i)
        for (const double value : {ms[2 * i], ms[2 * i + 1]})
            taken.push_back({x.place(value) - 5, y.place(kb[i]) - 5, 10, 10});
    for (std::size_t i = 0; i < kb.size(); ++i) {
        const auto& codec = sequence["codecs"][i];
        const char* color = codec["lossless"].get<bool>() ? "#1f5fa8" : "#d4700f";
        const double encode = x.place(ms[2 * i]), decode = x.place(ms[2 * i + 1]);
        const double height = y.place(kb[i]);
        out.line(encode, height, decode, height, color, 0.8);
        out.circle(decode, height, color, false);
        out.circle(encode, height, color, true);

        // The label goes to the first free position beside the marks.
        const std::string name = codec["name"];
        const double width = letter_width * double(name.size());
        const double rightmost = std::max(encode, decode), leftmost = std::min(encode, decode);
        Box best{};
        bool found = false;
        for (int step = 0; step < 24 && !found; ++step) {
            const double shift = (step % 2 ? 1 : -1) * double((step + 1) / 2) * 6;
            for (const double begin : {rightmost + 8, leftmost - 8 - width}) {
                const Box box{begin, height + shift - line_height / 2, width, line_height};
                if (box.x < x.from || box.x + width > x.to + right - 2 || found)
                    continue;
                found = std::none_of(taken.begin(), taken.end(),
                                     [&](const Box& other) { return box.overlaps(other); });
                best = box;
            }
        }
        taken.push_back(best);
        out.text(best.x, best.y + line_height - 2.5, name, "start");
    }
}

}  // namespace

std::string size_speed_svg(const nlohmann::json& sequences) {
    constexpr std::size_t most_in_a_row = 3;
    const std::size_t columns = std::min(sequences.size(), most_in_a_row);
    const std::size_t rows = (sequences.size() + most_in_a_row - 1) / most_in_a_row;
    const double width = panel_width * double(columns), height = panel_height * double(rows);
    Plot drawing;
    for (std::size_t i = 0; i < sequences.size(); ++i) {
        drawing.begin_at(panel_width * double(i % most_in_a_row),
                         panel_height * double(i / most_in_a_row));
        draw_panel(drawing, sequences[i]);
        drawing.end();
    }
    const std::string size =
        "width='" + formatted("%.0f", width) + "' height='" + formatted("%.0f", height) + "'";
    return "<svg xmlns='http://www.w3.org/2000/svg' " + size + " viewBox='0 0 " +
           formatted("%.0f", width) + " " + formatted("%.0f", height) +
           "' font-family='sans-serif' font-size='11'>\n<rect " + size + " fill='#ffffff'/>\n" +
           drawing.svg() + "</svg>\n";
}

}  // namespace theatron::bench
