// SPDX-License-Identifier: Apache-2.0
#include "room/mark_shape.h"

#include <algorithm>
#include <cstdio>

#include "phrases/language.h"

namespace theatron::room {

using render::LinePiece;
using session::Mark;
using session::MarkKind;
using session::MarkPoint;

namespace {

constexpr double line_radius_m = 0.0016;
constexpr double disc_radius_m = 0.004, disc_half_widths = 2;
constexpr double arrow_head_m = 0.014, arrow_radius_m = 0.005, arrow_half_widths = 2.6;
constexpr double pin_height_m = 0.03, pin_radius_m = 0.005, pin_half_widths = 3;

LinePiece straight(Vec3 from, Vec3 to) {
    return {from, to, line_radius_m, line_radius_m};
}

LinePiece disc(Vec3 place, double radius_m, double half_widths) {
    return {place, place, radius_m, radius_m, half_widths, half_widths};
}

Vec3 pin_head(const MarkPoint& foot) {
    return foot.position + normalized(foot.normal) * pin_height_m;
}

std::vector<LinePiece> arrow(Vec3 tail, Vec3 tip) {
    const double reach = length(tip - tail);
    const double head = std::min(arrow_head_m, 0.7 * reach);
    const Vec3 neck = reach > 1e-6 ? tip + (tail - tip) * (head / reach) : tip;
    return {straight(tail, neck), {neck, tip, arrow_radius_m, 0, arrow_half_widths, 0}};
}

}  // namespace

std::vector<LinePiece> mark_line(const Mark& mark) {
    const std::vector<MarkPoint>& points = mark.points;
    std::vector<LinePiece> pieces;
    switch (mark.kind) {
        case MarkKind::stroke:
            for (std::size_t i = 1; i < points.size(); ++i)
                pieces.push_back(straight(points[i - 1].position, points[i].position));
            break;
        case MarkKind::arrow:
            return arrow(points[0].position, points[1].position);
        case MarkKind::pin:
            pieces.push_back(straight(points[0].position, pin_head(points[0])));
            pieces.push_back(disc(pin_head(points[0]), pin_radius_m, pin_half_widths));
            break;
        case MarkKind::distance:
            // Straight through the air or the organ: the length that is measured.
            pieces.push_back(straight(points[0].position, points[1].position));
            for (const MarkPoint& point : points)
                pieces.push_back(disc(point.position, disc_radius_m, disc_half_widths));
            break;
    }
    return pieces;
}

std::string label_of(const Mark& mark) {
    const auto signed_text = [&](const std::string& text) {
        return mark.initials.empty() ? text : text + " " + mark.initials;
    };
    if (mark.kind == MarkKind::pin)
        return signed_text(std::to_string(mark.number));
    if (mark.kind != MarkKind::distance)
        return mark.initials;
    const double mm = 1000 * length(mark.points[1].position - mark.points[0].position);
    // Its other end is not known yet.
    if (mm == 0)
        return "";
    char text[64];
    if (mark.deviation_m > 0)
        std::snprintf(text, sizeof(text), "%.1f mm \u00b1 %.1f mm", mm,
                      2000 * double(mark.deviation_m));
    else
        std::snprintf(text, sizeof(text), "%.1f mm", mm);
    return signed_text(decimal(text));
}

std::string short_label_of(const Mark& mark) {
    if (mark.kind != MarkKind::distance || label_of(mark).empty())
        return label_of(mark);
    const double mm = 1000 * length(mark.points[1].position - mark.points[0].position);
    const std::string whole = std::to_string(std::lround(mm));
    // An uncertainty is not told smaller than the long label tells it, in tenths.
    const long tenths = std::lround(20'000 * double(mark.deviation_m));
    return mark.deviation_m > 0 ? whole + " \u00b1 " + std::to_string((tenths + 9) / 10) + " mm"
                                : whole + " mm";
}

render::LabelRank rank_of(MarkKind kind) {
    return kind == MarkKind::distance ? render::LabelRank::number
           : kind == MarkKind::pin    ? render::LabelRank::name
                                      : render::LabelRank::author;
}

std::vector<Vec3> label_places(const Mark& mark) {
    const Vec3 first = mark.points.front().position, last = mark.points.back().position;
    if (mark.kind == MarkKind::pin)
        return {pin_head(mark.points[0])};
    if (mark.kind != MarkKind::distance)
        return {last, first};
    return {(first + last) * 0.5, last, first, first * 0.75 + last * 0.25,
            first * 0.25 + last * 0.75};
}

}  // namespace theatron::room
