// SPDX-License-Identifier: Apache-2.0
#include "photon/strip_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

namespace theatron::photon {
namespace {

constexpr double least_contrast = 20;
// Shares of the way from black to white. Between the two outer ones a cell may change its colour
// while the picture is taken, between the inner ones it surely does.
constexpr double least_change = 0.2, most_black = 0.42, least_white = 0.58, most_change = 0.8;

// A line through the middle of many points.
struct Line {
    Point middle, direction;
};

// Least squares, then once more without the points that lie farthest away.
std::optional<Line> fitted(std::vector<Point> points) {
    constexpr std::size_t least_points = 8;
    Line line;
    for (int round = 0; round < 3; ++round) {
        if (points.size() < least_points)
            return std::nullopt;
        line.middle = {};
        for (const Point p : points)
            line.middle = line.middle + p * (1.0 / double(points.size()));
        double xx = 0, xy = 0, yy = 0;
        for (const Point p : points) {
            const Point d = p - line.middle;
            xx += d.x * d.x;
            xy += d.x * d.y;
            yy += d.y * d.y;
        }
        const double angle = std::atan2(2 * xy, xx - yy) / 2;
        line.direction = {std::cos(angle), std::sin(angle)};
        const auto distance = [&](Point p) {
            return std::abs(cross(line.direction, p - line.middle));
        };
        std::sort(points.begin(), points.end(),
                  [&](Point a, Point b) { return distance(a) < distance(b); });
        points.resize(points.size() - points.size() / 8);
    }
    return line;
}

std::optional<Point> meeting(const Line& a, const Line& b) {
    const double sine = cross(a.direction, b.direction);
    if (std::abs(sine) < 0.05)
        return std::nullopt;
    return a.middle + a.direction * (cross(b.middle - a.middle, b.direction) / sine);
}

// Where the brightness rises from inside to outside along a path of `reach` to both sides.
std::optional<Point> edge_near(GreyView grey, Point place, Point outward, double reach) {
    constexpr int most_steps = 64;
    const int steps = std::clamp(int(4 * reach), 8, most_steps);
    std::array<double, most_steps + 1> profile;
    const auto at = [&](double step) { return place + outward * (reach * (2 * step / steps - 1)); };
    for (int i = 0; i <= steps; ++i) {
        const auto brightness = brightness_at(grey, at(i));
        if (!brightness)
            return std::nullopt;
        profile[std::size_t(i)] = *brightness;
    }
    // The steepest rise over a quarter of the path.
    const int span = std::max(steps / 4, 2);
    int best = 0;
    double most = 0;
    for (int i = 0; i + span <= steps; ++i)
        if (const double rise = profile[std::size_t(i + span)] - profile[std::size_t(i)];
            rise > most) {
            most = rise;
            best = i;
        }
    if (most < least_contrast / 2)
        return std::nullopt;
    const double middle = profile[std::size_t(best)] + most / 2;
    for (int i = best; i < best + span; ++i) {
        const double low = profile[std::size_t(i)], high = profile[std::size_t(i + 1)];
        if (low <= middle && high > middle)
            return at(i + (middle - low) / (high - low));
    }
    return std::nullopt;
}

std::optional<Line> edge_line(GreyView grey, Point from, Point to, double reach) {
    constexpr int samples = 48;
    const Point side = to - from;
    // Outside is to the left of a clockwise outline.
    const Point outward = Point{side.y, -side.x} * (1 / length(side));
    std::vector<Point> points;
    for (int i = 0; i < samples; ++i) {
        const double along = 0.06 + 0.88 * (i + 0.5) / samples;
        if (const auto edge = edge_near(grey, from + side * along, outward, reach))
            points.push_back(*edge);
    }
    return points.size() * 2 >= std::size_t(samples) ? fitted(std::move(points)) : std::nullopt;
}

std::optional<Quad> refined_once(GreyView grey, const Quad& frame, double reach) {
    std::array<Line, 4> lines;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto line = edge_line(grey, frame[i], frame[(i + 1) % 4], reach);
        if (!line)
            return std::nullopt;
        lines[i] = *line;
    }
    Quad result;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto corner = meeting(lines[(i + 3) % 4], lines[i]);
        if (!corner || length(*corner - frame[i]) > 3 * reach)
            return std::nullopt;
        result[i] = *corner;
    }
    return is_proper(result) ? std::optional(result) : std::nullopt;
}

// The brightness around a place of the strip; nullopt outside the picture.
std::optional<double> mean_around(GreyView grey, const PlaneMap& map, double x, double y) {
    constexpr double spread = 0.18;
    double sum = 0;
    for (const double dy : {-spread, 0.0, spread})
        for (const double dx : {-spread, 0.0, spread}) {
            const auto brightness = brightness_at(grey, map.to_picture({x + dx, y + dy}));
            if (!brightness)
                return std::nullopt;
            sum += *brightness;
        }
    return sum / 9;
}

// Black and white as they are seen above and below a column.
struct Levels {
    double black, white;
};

std::optional<Levels> levels_at(GreyView grey, const PlaneMap& map, double x) {
    const auto upper_white = mean_around(grey, map, x, 0.5);
    const auto lower_white = mean_around(grey, map, x, strip_height - 0.5);
    const auto upper_black = mean_around(grey, map, x, 1.5);
    const auto lower_black = mean_around(grey, map, x, strip_height - 1.5);
    if (!upper_white || !lower_white || !upper_black || !lower_black)
        return std::nullopt;
    return Levels{(*upper_black + *lower_black) / 2, (*upper_white + *lower_white) / 2};
}

// The time that a picture shows whose cells are black (0), white (1) or between.
std::optional<StripTime> time_shown(
    const std::array<double, std::tuple_size_v<StripCells>>& shares) {
    StripCells cells{}, is_changing{};
    bool is_certain = true;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        cells[i] = shares[i] > 0.5;
        is_certain = is_certain && (shares[i] < most_black || shares[i] > least_white);
        is_changing[i] = shares[i] > least_change && shares[i] < most_change;
    }
    if (const auto time = is_certain ? time_of(cells) : std::nullopt)
        return time;
    const auto change = changing_times_of(cells, is_changing);
    if (!change)
        return std::nullopt;
    // The one of which there is more light.
    const StripCells later = cells_of(change->later);
    double more_of_later = 0;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (is_changing[i])
            more_of_later += later[i] ? shares[i] - 0.5 : 0.5 - shares[i];
    return more_of_later > 0 ? change->later : change->earlier;
}

}  // namespace

std::optional<Quad> refined(GreyView grey, const Quad& frame) {
    const double height = std::min({length(frame[1] - frame[0]), length(frame[2] - frame[1]),
                                    length(frame[3] - frame[2]), length(frame[0] - frame[3])});
    const double cell = height / (strip_height - 2);
    std::optional<Quad> result = refined_once(grey, frame, std::max(0.95 * cell, 2.0));
    if (result)
        result = refined_once(grey, *result, std::max(0.7 * cell, 1.5));
    return result;
}

std::optional<StripReading> read_strip(GreyView grey, const Quad& frame) {
    const PlaneMap map(frame, {1, 1}, {strip_width - 1, strip_height - 1});
    std::array<double, std::tuple_size_v<StripCells>> shares;
    double contrast = 255;
    for (int column = 0; column < strip_columns; ++column) {
        const double x = column + 2.5;
        const auto levels = levels_at(grey, map, x);
        if (!levels || levels->white - levels->black < least_contrast)
            return std::nullopt;
        contrast = std::min(contrast, levels->white - levels->black);
        for (int row = 0; row < strip_rows; ++row) {
            const auto brightness = mean_around(grey, map, x, row + 2.5);
            if (!brightness)
                return std::nullopt;
            const double share = (*brightness - levels->black) / (levels->white - levels->black);
            if (const auto fixed = fixed_cell(column, row); fixed && *fixed != (share > 0.5))
                return std::nullopt;
            shares[std::size_t(row * strip_columns + column)] = share;
        }
    }
    return StripReading{frame, time_shown(shares), contrast};
}

}  // namespace theatron::photon
