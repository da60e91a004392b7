// SPDX-License-Identifier: Apache-2.0
#include "enrol/photo_canvas.h"

#include <cmath>
#include <utility>

namespace theatron::enrol {
namespace {

// A dark edge keeps points and lines visible on skin of any colour.
constexpr Rgb edge{10, 20, 24};

std::uint8_t mixed(double from, double to, double share) {
    return std::uint8_t(std::lround(from + (to - from) * share));
}

void mix(Rgb& pixel, Rgb color, double share) {
    pixel = {mixed(pixel.r, color.r, share), mixed(pixel.g, color.g, share),
             mixed(pixel.b, color.b, share)};
}

// The photo between four of its pixels; the outermost go on beyond their middles.
Rgb color_at(ColorView photo, double x, double y) {
    const double left = std::clamp(x - 0.5, 0.0, photo.size.width - 1.0);
    const double top = std::clamp(y - 0.5, 0.0, photo.size.height - 1.0);
    const int column = int(left), row = int(top);
    const int right = std::min(column + 1, photo.size.width - 1);
    const Rgb* upper = photo.row(row);
    const Rgb* lower = photo.row(std::min(row + 1, photo.size.height - 1));
    Rgb above = upper[column], below = lower[column];
    mix(above, upper[right], left - column);
    mix(below, lower[right], left - column);
    mix(above, below, top - row);
    return above;
}

// A line with round ends, `radius` on each side; of one point: a disc.
void draw_stroke(Vec2 from, Vec2 to, double radius, Rgb color, MutableColorView canvas) {
    const double dx = to.x - from.x, dy = to.y - from.y, squared = dx * dx + dy * dy;
    const auto first = [&](double a, double b) {
        return int(std::max(std::floor(std::min(a, b) - radius - 1), 0.0));
    };
    const auto end = [&](double a, double b, int size) {
        return int(std::clamp(std::ceil(std::max(a, b) + radius + 1), 0.0, double(size)));
    };
    const int right = end(from.x, to.x, canvas.size.width);
    const int bottom = end(from.y, to.y, canvas.size.height);
    for (int y = first(from.y, to.y); y < bottom; ++y)
        for (int x = first(from.x, to.x); x < right; ++x) {
            const double px = x + 0.5 - from.x, py = y + 0.5 - from.y;
            const double along =
                squared > 0 ? std::clamp((px * dx + py * dy) / squared, 0.0, 1.0) : 0;
            const double away = std::hypot(px - along * dx, py - along * dy);
            const double cover = std::clamp(radius + 0.5 - away, 0.0, 1.0);
            if (cover > 0)
                mix(canvas.row(y)[x], color, cover);
        }
}

}  // namespace

void draw_photo(ColorView photo, const PhotoPlace& place, bool mirrored, MutableColorView canvas) {
    const Size size = photo.size;
    for (int y = 0; y < canvas.size.height; ++y)
        for (int x = 0; x < canvas.size.width; ++x) {
            const Vec2 at = place.photo_of({x + 0.5, y + 0.5});
            const bool is_inside =
                at.x >= 0 && at.y >= 0 && at.x < size.width && at.y < size.height;
            canvas.row(y)[x] = is_inside
                                   ? color_at(photo, mirrored ? size.width - at.x : at.x, at.y)
                                   : canvas_ground;
        }
}

void draw_landmarks(const face::LandmarkDraft& draft, std::optional<std::size_t> chosen,
                    const PhotoPlace& place, double dot_px, MutableColorView canvas) {
    const auto at = [&](std::size_t landmark) { return place.window_of(draft.point(landmark)); };
    if (!draft.next())
        for (const face::LandmarkLine& line : face::landmark_lines)
            for (std::size_t i = line.first; i <= line.last; ++i) {
                const std::size_t next = i < line.last ? i + 1 : line.is_closed ? line.first : i;
                draw_stroke(at(i), at(next), 0.3 * dot_px, landmark_color, canvas);
            }
    for (std::size_t i = 0; i < face::landmark_count; ++i) {
        if (!draft.is_shown(i))
            continue;
        const bool is_chosen = chosen == i;
        draw_stroke(at(i), at(i), is_chosen ? 1.5 * dot_px : dot_px + 1, edge, canvas);
        draw_stroke(at(i), at(i), is_chosen ? 1.5 * dot_px - 1 : dot_px,
                    is_chosen ? chosen_color : landmark_color, canvas);
    }
}

void draw_cross(Vec2 at, double size_px, MutableColorView canvas) {
    for (const auto& [radius, color] : {std::pair(2.5, edge), std::pair(1.0, chosen_color)}) {
        draw_stroke({at.x - size_px, at.y}, {at.x + size_px, at.y}, radius, color, canvas);
        draw_stroke({at.x, at.y - size_px}, {at.x, at.y + size_px}, radius, color, canvas);
    }
}

}  // namespace theatron::enrol
