// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "svg_drawing.h"
#include "table1_page.h"

namespace theatron::bench {
namespace {

constexpr double width = 780, label_width = 250, right = 24;
constexpr double top = 14, row_height = 34, bottom = 40;
constexpr const char* paper_color = "#b35900";
constexpr const char* here_color = "#1f5fa8";

void collect(const Table1Cell& cell, std::vector<double>& values) {
    if (cell.spread && cell.spread->low > 0)
        values.insert(values.end(), {cell.spread->low, cell.spread->high});
}

void draw(SvgDrawing& out, const Table1Cell& cell, const LogAxis& x, double y, bool filled) {
    if (!cell.spread || cell.spread->low <= 0)
        return;
    out.line(x.place(cell.spread->low), y, x.place(cell.spread->high), y, here_color, 2);
    out.circle(x.place(cell.spread->median), y, here_color, filled);
}

}  // namespace

std::string table1_plot(const std::vector<const Table1Row*>& rows) {
    std::vector<double> values;
    for (const Table1Row* row : rows) {
        if (row->paper_low)
            values.insert(values.end(), {*row->paper_low, *row->paper_high});
        collect(row->same, values);
        collect(row->best, values);
    }
    if (values.empty())
        return "";
    const double end = top + row_height * double(rows.size());
    LogAxis x = axis_of(values, label_width, width - right);
    // An axis shorter than this has no two labels.
    if (x.high < 4 * x.low) {
        x.low /= 2;
        x.high *= 2;
    }
    SvgDrawing out;
    for (const double tick : x.ticks()) {
        out.line(x.place(tick), top, x.place(tick), end, "#e3e3e3", 1);
        out.text(x.place(tick), end + 14, formatted("%g", tick), "middle");
    }
    out.text((label_width + width - right) / 2, end + 30,
             rows.front()->unit + ", logarithmic; to the left is " +
                 (rows.front()->unit == "ms" ? "shorter" : "smaller"),
             "middle", "fill='#555555'");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Table1Row& row = *rows[i];
        const double y = top + row_height * (double(i) + 0.5);
        if (i > 0)
            out.line(0, y - row_height / 2, width - right, y - row_height / 2, "#f0f0f0", 1);
        out.text(label_width - 10, y + 4, row.name, "end");
        if (row.paper_low) {
            out.line(x.place(*row.paper_low), y - 9, x.place(*row.paper_high), y - 9, paper_color,
                     2);
            out.diamond(x.place(*row.paper_low), y - 9, paper_color);
            if (*row.paper_high != *row.paper_low)
                out.diamond(x.place(*row.paper_high), y - 9, paper_color);
        }
        draw(out, row.same, x, y, false);
        draw(out, row.best, x, y + 9, true);
        if (!row.same.spread && !row.best.spread)
            out.text(label_width + 8, y + 9, "no figure here: see the table", "start",
                     "fill='#555555'");
    }
    return out.document(width, end + bottom);
}

}  // namespace theatron::bench
