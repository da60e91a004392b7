// SPDX-License-Identifier: Apache-2.0
#include "or_screen/layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace theatron::or_screen {
namespace {

// In letters' heights.
constexpr double margin = 0.5, gap = 0.5, line = 1.8, tall_card = 4.3, flat_card = 2.6;
constexpr std::size_t least_columns = 3, most_columns = 4;
// The share of the width that the column of room and monitor has at least, and at most where the
// picture leaves more.
constexpr double least_side = 0.2;
constexpr Size usual_picture{16, 9};

// The cards of people along the lower edge; takes their space away from `area`.
void place_cards(Layout& layout, std::size_t people, Rect& area) {
    const std::size_t shown = std::clamp(people, std::size_t(1), Layout::most_cards);
    layout.left_out = people > Layout::most_cards ? people - (Layout::most_cards - 1) : 0;
    layout.two_lines = shown <= most_columns;
    const std::size_t columns = std::clamp(shown, least_columns, most_columns);
    const std::size_t rows = layout.two_lines ? 1 : 2;
    const double apart = gap * layout.letter;
    const double height = (layout.two_lines ? tall_card : flat_card) * layout.letter;
    const double width = (area.width - double(columns - 1) * apart) / double(columns);
    area.height -= double(rows) * (height + apart);
    for (std::size_t i = 0; i < shown; ++i) {
        const auto column = double(i % columns), row = double(i / columns);
        layout.cards.push_back({area.x + column * (width + apart),
                                area.bottom() + apart + row * (height + apart), width, height});
    }
}

// Room and monitor share `area`: below each other where it is tall, else beside each other.
void place_side(Layout& layout, const Rect& area, bool has_monitor) {
    const double apart = gap * layout.letter;
    layout.room = area;
    if (!has_monitor)
        return;
    layout.monitor = area;
    if (area.height > area.width) {
        layout.room.height = layout.monitor.height = (area.height - apart) / 2;
        layout.monitor.y += layout.room.height + apart;
    } else {
        layout.room.width = layout.monitor.width = (area.width - apart) / 2;
        layout.monitor.x += layout.room.width + apart;
    }
}

}  // namespace

Rect fitted(Size proportions, const Rect& room) {
    if (proportions.area() == 0)
        return room;
    const double scale = std::min(room.width / proportions.width, room.height / proportions.height);
    const double width = proportions.width * scale, height = proportions.height * scale;
    return {room.x + (room.width - width) / 2, room.y + (room.height - height) / 2, width, height};
}

Rect label_place(Vec2 at, Vec2 size, double apart, const Rect& area,
                 const std::vector<Rect>& there) {
    const auto kept = [](double value, double least, double most) {
        return std::clamp(value, least, std::max(least, most));
    };
    const auto covered = [&](const Rect& label) {
        double sum = 0;
        for (const Rect& other : there) {
            const double width =
                std::min(label.right(), other.right()) - std::max(label.x, other.x);
            const double height =
                std::min(label.bottom(), other.bottom()) - std::max(label.y, other.y);
            if (width > 0 && height > 0)
                sum += width * height;
        }
        return sum;
    };
    std::optional<Rect> best;
    double least = 0;
    // Near places first; at each distance below and to the right first.
    for (const double reach : {1.0, 2.5, 4.0})
        for (const int down : {1, 0, -1})
            for (const int right : {1, -1, 0}) {
                if (down == 0 && right == 0)
                    continue;
                const auto begin = [&](double middle, double length, int side) {
                    return middle + side * reach * apart - (1 - side) * length / 2;
                };
                const Rect label{kept(begin(at.x, size.x, right), area.x, area.right() - size.x),
                                 kept(begin(at.y, size.y, down), area.y, area.bottom() - size.y),
                                 size.x, size.y};
                if (const double covers = covered(label); !best || covers < least) {
                    best = label;
                    least = covers;
                }
            }
    return *best;
}

Layout layout(const LayoutFacts& facts) {
    Layout layout;
    layout.letter = Layout::letter_share * std::min(facts.screen.width, facts.screen.height);
    const double edge = (margin + largest_drift) * layout.letter, apart = gap * layout.letter;
    Rect area{edge, edge, facts.screen.width - 2 * edge, facts.screen.height - 2 * edge};
    place_cards(layout, facts.people, area);

    const Size picture = facts.picture.area() > 0 ? facts.picture : usual_picture;
    const double caption = line * layout.letter;
    const bool is_wide = area.width > area.height;
    Rect main = area, side = area;
    if (is_wide) {
        main.height -= caption;
        main.width = std::min(main.height * picture.width / picture.height,
                              (1 - least_side) * area.width - apart);
        side.x = main.right() + apart;
        side.width = area.right() - side.x;
    } else {
        main.height = std::min(main.width * picture.height / picture.width,
                               (area.height - caption - apart) * 0.6);
        side.y = main.bottom() + caption + apart;
        side.height = area.bottom() - side.y;
    }
    layout.picture = fitted(picture, main);
    layout.picture.y = main.y;
    layout.caption = {main.x, layout.picture.bottom(), main.width, caption};
    place_side(layout, side, facts.has_monitor);
    return layout;
}

Vec2 drift(TimePoint now) {
    // Periods without a small common multiple, so that the path covers the whole square.
    constexpr double period_x_s = 431, period_y_s = 617;
    const double turn = 2 * std::numbers::pi * to_seconds(now.time_since_epoch());
    return {largest_drift * std::sin(turn / period_x_s),
            largest_drift * std::sin(turn / period_y_s)};
}

Rect moved(Rect rect, Vec2 by) {
    rect.x += by.x;
    rect.y += by.y;
    return rect;
}

}  // namespace theatron::or_screen
