// SPDX-License-Identifier: Apache-2.0
// Plots as SVG: shapes, texts and a logarithmic axis.
#pragma once

#include <string>
#include <vector>

namespace theatron::bench {

// A number as printf writes it; at most 63 characters.
std::string formatted(const char* format, double value);

// The text inside an element or an attribute of SVG or HTML.
std::string escaped(const std::string& text);

// A logarithmic axis from values to positions. Values are positive, low < high.
struct LogAxis {
    double low = 1, high = 10;  // values
    double from = 0, to = 1;    // positions

    double place(double value) const;
    // 1, 2 and 5 times powers of ten; only powers of ten for long axes.
    std::vector<double> ticks() const;
};

// The axis of all these values, slightly longer than their range. There is at least one.
LogAxis axis_of(const std::vector<double>& values, double from, double to);

// Shapes in the order in which they are drawn. Positions are pixels, y down.
class SvgDrawing {
public:
    void line(double x1, double y1, double x2, double y2, const char* color, double width);
    void circle(double x, double y, const char* color, bool filled);
    void diamond(double x, double y, const char* color);
    // `anchor`: start, middle or end. `more`: further attributes.
    void text(double x, double y, const std::string& words, const char* anchor,
              const char* more = "");
    // Moves the origin for all following shapes, until end().
    void begin_at(double x, double y);
    void end();

    // The whole picture, with a white background, for light and dark pages.
    std::string document(double width, double height) const;

private:
    static std::string number(double value) { return formatted("%.1f", value); }
    std::string svg_;
};

}  // namespace theatron::bench
