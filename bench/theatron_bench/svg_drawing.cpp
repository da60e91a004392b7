// SPDX-License-Identifier: Apache-2.0
#include "svg_drawing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace theatron::bench {

std::string formatted(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof(text), format, value);
    return text;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        result += c == '&'    ? std::string("&amp;")
                  : c == '<'  ? std::string("&lt;")
                  : c == '>'  ? std::string("&gt;")
                  : c == '"'  ? std::string("&quot;")
                  : c == '\'' ? std::string("&#39;")
                              : std::string(1, c);
    return result;
}

double LogAxis::place(double value) const {
    return from + (to - from) * std::log(value / low) / std::log(high / low);
}

std::vector<double> LogAxis::ticks() const {
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

LogAxis axis_of(const std::vector<double>& values, double from, double to) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return {*low / 1.25, *high * 1.25, from, to};
}

void SvgDrawing::line(double x1, double y1, double x2, double y2, const char* color, double width) {
    svg_ += "<line x1='" + number(x1) + "' y1='" + number(y1) + "' x2='" + number(x2) + "' y2='" +
            number(y2) + "' stroke='" + color + "' stroke-width='" + number(width) + "'/>\n";
}

void SvgDrawing::circle(double x, double y, const char* color, bool filled) {
    svg_ += "<circle cx='" + number(x) + "' cy='" + number(y) + "' r='4' stroke='" + color +
            "' stroke-width='1.5' fill='" + (filled ? color : "#ffffff") + "'/>\n";
}

void SvgDrawing::diamond(double x, double y, const char* color) {
    svg_ += "<path d='M" + number(x - 5) + " " + number(y) + "L" + number(x) + " " + number(y - 5) +
            "L" + number(x + 5) + " " + number(y) + "L" + number(x) + " " + number(y + 5) +
            "Z' fill='" + color + "'/>\n";
}

void SvgDrawing::text(double x, double y, const std::string& words, const char* anchor,
                      const char* more) {
    svg_ += "<text x='" + number(x) + "' y='" + number(y) + "' text-anchor='" + anchor + "' " +
            more + ">" + escaped(words) + "</text>\n";
}

void SvgDrawing::begin_at(double x, double y) {
    svg_ += "<g transform='translate(" + number(x) + " " + number(y) + ")'>\n";
}

void SvgDrawing::end() {
    svg_ += "</g>\n";
}

std::string SvgDrawing::document(double width, double height) const {
    const std::string size =
        "width='" + formatted("%.0f", width) + "' height='" + formatted("%.0f", height) + "'";
    return "<svg xmlns='http://www.w3.org/2000/svg' " + size + " viewBox='0 0 " +
           formatted("%.0f", width) + " " + formatted("%.0f", height) +
           "' font-family='sans-serif' font-size='11'>\n<rect " + size + " fill='#ffffff'/>\n" +
           svg_ + "</svg>\n";
}

}  // namespace theatron::bench
