// SPDX-License-Identifier: Apache-2.0
#include "registration/target_drawing.h"

#include <cstdarg>
#include <cstdio>

namespace theatron::registration {
namespace {

constexpr double mm = 1000;
constexpr double text_mm = 9;

[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
    char buffer[512];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(buffer, sizeof(buffer), format, arguments);
    va_end(arguments);
    return buffer;
}

std::vector<std::string> notes(const LatticeTarget& t) {
    const Rect c = cell(t, 0, 0);
    return {
        text("Theatron lattice target, FRONT  %.0f x %.0f mm, board %.1f mm thick", t.width_m * mm,
             t.height_m * mm, t.thickness_m * mm),
        text("bars %.1f mm, holes %.2f x %.2f mm", t.bar_m * mm, c.width() * mm, c.height() * mm),
        "Matt, light, flat. Check: the cut board must measure as above."};
}

// The solid corner has room for the note: upper left, on the first filled cells.
Rect note_place(const LatticeTarget& t) {
    const Rect a = cell(t, 0, 0), b = cell(t, 1, 0);
    return {a.left, a.bottom, b.right, a.top};
}

}  // namespace

std::string svg_drawing(const LatticeTarget& t) {
    const Rect board = outline(t);
    // y down in the drawing, its origin at the board's upper left corner.
    const auto rect = [&](const Rect& r) {
        return text("  <rect x=\"%.3f\" y=\"%.3f\" width=\"%.3f\" height=\"%.3f\"/>\n",
                    (r.left - board.left) * mm, (board.top - r.top) * mm, r.width() * mm,
                    r.height() * mm);
    };
    std::string svg = text(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.3fmm\" height=\"%.3fmm\" "
        "viewBox=\"0 0 %.3f %.3f\">\n"
        "<g fill=\"none\" stroke=\"#ff0000\" stroke-width=\"0.2\">\n",
        t.width_m * mm, t.height_m * mm, t.width_m * mm, t.height_m * mm);
    svg += rect(board);
    for (const Rect& hole : holes(t, Face::front))
        svg += rect(hole);
    svg += text("</g>\n<g fill=\"#000000\" font-family=\"sans-serif\" font-size=\"%.1f\">\n",
                text_mm * t.width_m / 0.8);
    const Rect place = note_place(t);
    double line = (board.top - place.top) * mm + text_mm;
    for (const std::string& note : notes(t)) {
        svg += text("  <text x=\"%.3f\" y=\"%.3f\">%s</text>\n", (place.left - board.left) * mm,
                    line, note.c_str());
        line += text_mm * 1.6;
    }
    return svg + "</g>\n</svg>\n";
}

std::string dxf_drawing(const LatticeTarget& t) {
    const Rect board = outline(t);
    std::string dxf =
        "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n"
        "0\nSECTION\n2\nENTITIES\n";
    const auto polyline = [&](const Rect& r) {
        const double xs[4] = {r.left, r.right, r.right, r.left};
        const double ys[4] = {r.bottom, r.bottom, r.top, r.top};
        dxf += "0\nPOLYLINE\n8\nCUT\n66\n1\n70\n1\n";
        for (int i = 0; i < 4; ++i)
            dxf += text("0\nVERTEX\n8\nCUT\n10\n%.3f\n20\n%.3f\n30\n0.0\n",
                        (xs[i] - board.left) * mm, (ys[i] - board.bottom) * mm);
        dxf += "0\nSEQEND\n8\nCUT\n";
    };
    polyline(board);
    for (const Rect& hole : holes(t, Face::front))
        polyline(hole);
    const Rect place = note_place(t);
    double line = (place.top - board.bottom) * mm - text_mm;
    for (const std::string& note : notes(t)) {
        dxf += text("0\nTEXT\n8\nNOTE\n10\n%.3f\n20\n%.3f\n30\n0.0\n40\n%.1f\n1\n%s\n",
                    (place.left - board.left) * mm, line, text_mm * 0.7, note.c_str());
        line -= text_mm * 1.6;
    }
    return dxf + "0\nENDSEC\n0\nEOF\n";
}

}  // namespace theatron::registration
