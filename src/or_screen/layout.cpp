// SPDX-License-Identifier: Apache-2.0
#include "or_screen/layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace theatron::or_screen {
namespace {

// In letters' heights.
constexpr double margin = 0.5, gap = 0.5, line = 1.8, tall_card = 4.3, flat_card = 2.6;
constexpr std::size_t least_columns = 3, most_columns = 4;
// The share of the width that the column of room and monitor has at least, and at most where the
// picture leaves more.
constexpr double least_side = 0.2;
// The monitor's part of the column: images have letters and lines of text.
constexpr double monitor_share = 0.62;
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
        layout.monitor.height = monitor_share * (area.height - apart);
        layout.room.height = area.height - apart - layout.monitor.height;
        layout.monitor.y += layout.room.height + apart;
    } else {
        layout.monitor.width = monitor_share * (area.width - apart);
        layout.room.width = area.width - apart - layout.monitor.width;
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

MonitorPlaces monitor_places(const Rect& monitor, Size slice, std::size_t lines, double letter) {
    // In letters' heights.
    constexpr double line_height = 1.55, least_width = 5.4, least_height = 3.6;
    MonitorPlaces places;
    const double below = double(lines) * line_height * letter;
    const Rect area{monitor.x, monitor.y, monitor.width, monitor.height - below};
    places.picture = fitted(slice, area);
    places.letters.width =
        std::max(places.picture.width, std::min(area.width, least_width * letter));
    places.letters.height =
        std::max(places.picture.height, std::min(area.height, least_height * letter));
    places.letters.x = area.x + (area.width - places.letters.width) / 2;
    places.letters.y = area.y + (area.height - places.letters.height) / 2;
    for (std::size_t i = 0; i < lines; ++i)
        places.lines.push_back({monitor.x,
                                monitor.bottom() - below + double(i) * line_height * letter,
                                monitor.width, line_height * letter});
    return places;
}

double scale_to_fit(double width, double most) {
    constexpr double least = 0.45;
    return width <= most ? 1 : std::max(most / width, least);
}

Rect letters_place(const Rect& area, Vec2 towards, std::size_t letters, double letter) {
    constexpr double high = 1.44, wide = 1.0, beside = 0.7, apart = 0.15;  // in letters' heights
    const Vec2 size{(double(letters) * wide + beside) * letter, high * letter};
    const double free = apart * letter;
    const auto begin = [&](double from, double whole, double side, double way) {
        return from + (whole - side) / 2 + way * ((whole - side) / 2 - free);
    };
    return {begin(area.x, area.width, size.x, towards.x),
            begin(area.y, area.height, size.y, towards.y), size.x, size.y};
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
