// SPDX-License-Identifier: Apache-2.0
#include "registration/registration_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace theatron::registration {
namespace {

template <class... Values>
std::string text(const char* format, Values... values) {
    char buffer[400];
    std::snprintf(buffer, sizeof(buffer), format, values...);
    return buffer;
}

std::string escaped(const std::string& raw) {
    std::string result;
    for (const char c : raw)
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    return result;
}

constexpr double most_mm = 10;  // darker, or in the last bar, from here on

// From light to dark, also apart for the colour-blind and in grey.
std::string color_of(double mm) {
    constexpr std::array<std::array<int, 3>, 5> stops{
        {{198, 219, 239}, {107, 174, 214}, {120, 190, 90}, {240, 150, 40}, {170, 20, 40}}};
    const double at = std::clamp(mm / most_mm, 0.0, 1.0) * (double(stops.size()) - 1);
    const std::size_t i = std::min(stops.size() - 2, std::size_t(at));
    const auto mix = [&](std::size_t k) {
        return int(std::lround(stops[i][k] + (at - double(i)) * (stops[i + 1][k] - stops[i][k])));
    };
    return text("#%02x%02x%02x", mix(0), mix(1), mix(2));
}

struct Box {
    double left = 1e9, right = -1e9, near = 1e9, far = -1e9;  // x and z of the room

    void hold(Vec3 p) {
        left = std::min(left, p.x);
        right = std::max(right, p.x);
        near = std::min(near, p.z);
        far = std::max(far, p.z);
    }
};

// The room from above, one drawing for before and one for after: -z is up.
std::string map_of(const RegistrationReport& report, const Box& box, bool after) {
    constexpr double width = 460, margin = 34;
    const double metres = std::max({box.right - box.left, box.far - box.near, 0.5});
    const double scale = (width - 2 * margin) / metres;
    const double height = (box.far - box.near) * scale + 2 * margin;
    const auto x = [&](double v) { return margin + (v - box.left) * scale; };
    const auto y = [&](double v) { return margin + (v - box.near) * scale; };
    std::string svg =
        text("<svg viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" role=\"img\">", width, height, width);
    for (auto m = std::int64_t(std::ceil(box.left)); double(m) <= box.right; ++m)
        svg += text("<line class=grid x1=%.1f y1=0 x2=%.1f y2=%.0f />", x(double(m)), x(double(m)),
                    height);
    for (auto m = std::int64_t(std::ceil(box.near)); double(m) <= box.far; ++m)
        svg += text("<line class=grid x1=0 y1=%.1f x2=%.0f y2=%.1f />", y(double(m)), width,
                    y(double(m)));
    for (const RegistrationReport::Pair& pair : report.pairs)
        for (const RegistrationReport::Surface& s : after ? pair.after : pair.before)
            svg += text("<circle cx=%.1f cy=%.1f r=2.6 fill=\"%s\" />", x(s.at.x), y(s.at.z),
                        color_of(s.apart_mm).c_str());
    for (const Vec3& place : report.places)
        svg += text("<path class=place d=\"M%.1f %.1fh8m-4 -4v8\" />", x(place.x) - 4, y(place.z));
    for (const RegistrationReport::Camera& camera : report.cameras) {
        const Pose& pose = after || !camera.earlier ? camera.room_from_camera : *camera.earlier;
        const Vec3 at = pose.translation, ahead = rotate(pose.rotation, {0, 0, 1});
        const double angle = std::atan2(ahead.z, ahead.x) / radians_of(1);
        svg += text(
            "<g transform=\"translate(%.1f %.1f)\"><path class=camera "
            "transform=\"rotate(%.1f)\" d=\"M-5 0L9 -8V8Z\" />",
            x(at.x), y(at.z), angle);
        svg += "<text y=-10>" + escaped(camera.name) + "</text></g>";
    }
    return svg + "</svg>";
}

double median(std::vector<double> values) {
    if (values.empty())
        return 0;
    const auto middle = values.begin() + long(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::vector<double> distances(const std::vector<RegistrationReport::Surface>& surfaces) {
    std::vector<double> mm;
    for (const RegistrationReport::Surface& s : surfaces)
        mm.push_back(std::abs(s.apart_mm));
    return mm;
}

// Bars of half a millimetre: filled for after, outlined for before.
std::string histogram(const RegistrationReport::Pair& pair) {
    constexpr int bars = int(2 * most_mm) + 1;
    constexpr double width = 460, height = 150, bottom = 126, left = 8;
    constexpr double step = (width - 2 * left) / bars;
    const auto shares = [&](const std::vector<RegistrationReport::Surface>& surfaces) {
        std::array<double, std::size_t(bars)> share{};
        for (const double mm : distances(surfaces))
            share[std::size_t(std::min(bars - 1, int(2 * mm)))] += 1 / double(surfaces.size());
        return share;
    };
    const auto before = shares(pair.before), after = shares(pair.after);
    double highest = 0.02;
    for (std::size_t i = 0; i < before.size(); ++i)
        highest = std::max({highest, before[i], after[i]});
    std::string svg =
        text("<svg viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" role=\"img\">", width, height, width);
    for (std::size_t i = 0; i < after.size(); ++i) {
        const double x = left + double(i) * step;
        const double ha = after[i] / highest * (bottom - 8),
                     hb = before[i] / highest * (bottom - 8);
        svg += text("<rect class=after x=%.1f y=%.1f width=%.1f height=%.1f />", x, bottom - ha,
                    step - 2, ha);
        svg += text("<rect class=before x=%.1f y=%.1f width=%.1f height=%.1f />", x, bottom - hb,
                    step - 2, hb);
    }
    for (int mm = 0; mm <= int(most_mm); mm += 2)
        svg += mm == int(most_mm) ? text("<text class=last x=%.1f y=%.0f>%d+ mm</text>",
                                         width - left, height - 6, mm)
                                  : text("<text x=%.1f y=%.0f>%d</text>",
                                         left + 2 * mm * step + step / 2, height - 6, mm);
    return svg + "</svg>";
}

// A fixed error of depth in words: found, too small to be told from none, or known from before.
std::string error_cell(double value, double sigma, const char* unit) {
    if (sigma <= 0)
        return value == 0 ? "<td>not looked for</td>"
                          : text("<td>%+.1f %s, as before</td>", value, unit);
    const bool found = std::abs(value) > 2 * sigma;
    return text("<td%s>%+.1f &#177; %.1f %s</td>", found ? " class=found" : "", value, sigma, unit);
}

std::string camera_table(const RegistrationReport& report) {
    std::string html =
        "<table><tr><th>camera<th>views<th>of its picture<th>good to<th>x, y, z in the room<th>"
        "differs from before by</tr>";
    for (const RegistrationReport::Camera& c : report.cameras) {
        const Vec3 at = c.room_from_camera.translation;
        html += "<tr><td>" + escaped(c.name) + text("<td>%d<td>%d/9", c.views, c.ninths);
        html += c.is_reference ? std::string("<td>the reference")
                : c.sigma      ? text("<td>%.1f mm, %.2f&deg;", c.sigma->mm, c.sigma->deg)
                               : std::string("<td>not estimated");
        html += text("<td>%.3f, %.3f, %.3f m", at.x, at.y, at.z);
        if (c.earlier) {
            const Pose change = inverse(*c.earlier) * c.room_from_camera;
            const Quat& q = change.rotation;
            html +=
                text("<td>%.1f mm, %.2f&deg;", length(change.translation) * 1000,
                     2 * std::asin(std::min(1.0, std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z))) /
                         radians_of(1));
        } else {
            html += "<td>not known before";
        }
        html += "</tr>";
    }
    return html + "</table>";
}

std::string error_table(const RegistrationReport& report) {
    std::string html =
        "<table><tr><th>camera<th>offset at 2 m<th>slope to the right<th>slope downwards<th>growth "
        "with distance</tr>";
    for (const RegistrationReport::Camera& c : report.cameras) {
        const DepthBias &b = c.bias, &s = c.bias_sigma;
        html += "<tr><td>" + escaped(c.name) + "</td>" +
                error_cell(b.offset_m * 1000, s.offset_m * 1000, "mm") +
                error_cell(b.per_x_m * 1000, s.per_x_m * 1000, "mm per 45&deg;") +
                error_cell(b.per_y_m * 1000, s.per_y_m * 1000, "mm per 45&deg;") +
                error_cell(b.per_m * 1000, s.per_m * 1000, "mm/m") + "</tr>";
    }
    return html + "</table>";
}

std::string scale_of_colors() {
    std::string svg = "<svg viewBox=\"0 0 460 34\" width=\"460\" role=\"img\">";
    for (int i = 0; i < 40; ++i)
        svg += text("<rect x=%d y=2 width=11 height=12 fill=\"%s\" />", 10 + i * 11,
                    color_of(i * most_mm / 40).c_str());
    for (int mm = 0; mm <= int(most_mm); mm += 2)
        svg += mm == int(most_mm) ? text("<text class=last x=452 y=30>%d+ mm</text>", mm)
                                  : text("<text x=%.0f y=30>%d</text>", 12 + mm * 43.0, mm);
    return svg + "</svg>";
}

constexpr const char* head = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Registration of cameras</title><style>
body{font:15px/1.45 system-ui,sans-serif;color:#1c2430;background:#fff;max-width:980px;margin:28px auto;padding:0 16px}
h1{font-size:24px;margin:0 0 4px}h2{font-size:18px;margin:28px 0 6px}h3{font-size:15px;margin:0 0 2px}
table{border-collapse:collapse}td,th{padding:4px 12px 4px 0;text-align:left;border-bottom:1px solid #dde3ea}
.found{font-weight:600;color:#a0142d}.two{display:flex;flex-wrap:wrap;gap:24px}
.two>div{width:460px}svg{max-width:100%;background:#f7f9fb}svg text{font-size:11px;text-anchor:middle;fill:#1c2430}
svg .last{text-anchor:end}.grid{stroke:#e2e8ee}.camera{fill:#1c2430}.place{stroke:#1c2430;fill:none}
.after{fill:#4a90c8}.before{fill:none;stroke:#8a3b12;stroke-width:1.2}p.note{color:#52606f;margin:2px 0 8px}
</style></head><body>
)";

}  // namespace

std::string to_html(const RegistrationReport& report) {
    std::string html = head;
    html += "<h1>Registration of " + std::to_string(report.cameras.size()) + " cameras</h1><p>" +
            escaped(report.made) + "<br>" + escaped(report.method) + "</p>";
    for (const std::string& remark : report.remarks)
        html += "<p>" + escaped(remark) + "</p>";
    html += "<h2>Cameras</h2>" + camera_table(report);

    html +=
        "<h2>Fixed errors of depth</h2><p class=note>A camera measures too far by this. Bold: "
        "larger than twice its uncertainty, so it was found; the others cannot be told from "
        "none.</p>" +
        error_table(report);

    Box box;
    for (const RegistrationReport::Camera& c : report.cameras) {
        box.hold(c.room_from_camera.translation);
        if (c.earlier)
            box.hold(c.earlier->translation);
    }
    for (const RegistrationReport::Pair& pair : report.pairs)
        for (const auto* surfaces : {&pair.before, &pair.after})
            for (const RegistrationReport::Surface& s : *surfaces)
                box.hold(s.at);
    html +=
        "<h2>Distances of surfaces that two cameras see</h2><p class=note>The room from above, "
        "one line for each metre. A dot is a surface; its colour says how far apart two cameras "
        "have it. Crosses are places of the board. Before: " +
        escaped(report.before) + ".</p><div class=two><div><h3>Before</h3>" +
        map_of(report, box, false) + "</div><div><h3>After</h3>" + map_of(report, box, true) +
        "</div></div>" + scale_of_colors();

    html +=
        "<h2>Pairs of cameras</h2><p class=note>Shares of surfaces by their distance: outlined "
        "before, filled after.</p><div class=two>";
    for (const RegistrationReport::Pair& pair : report.pairs) {
        html += "<div><h3>" + escaped(report.cameras[pair.a].name) + " and " +
                escaped(report.cameras[pair.b].name) + "</h3><p class=note>";
        if (pair.places > 0)
            html += text("The board at %d common places: corners %.1f mm apart. ", pair.places,
                         pair.board_mm);
        if (pair.after.empty())
            html += "They see no common surface.</p></div>";
        else
            html +=
                text("Median of %zu surfaces: %.1f mm before, %.1f mm after.", pair.after.size(),
                     median(distances(pair.before)), median(distances(pair.after))) +
                std::string("</p>") + histogram(pair) + "</div>";
    }
    return html + "</div></body></html>\n";
}

}  // namespace theatron::registration
