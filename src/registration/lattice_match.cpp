// SPDX-License-Identifier: Apache-2.0
#include "registration/lattice_match.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace theatron::registration {
namespace {

constexpr double cell_m = 0.01;   // of the rectified picture
constexpr double rim_m = 0.04;    // around the outline nothing may lie on the plane
constexpr double search_m = 0.3;  // between the middle of the points and the middle of the board
constexpr double least_agreement = 0.9;
constexpr double least_known = 0.5;
constexpr double least_margin = 0.06;
constexpr int most_turns = 3;              // until the picture is upright
constexpr double straight_enough = 0.006;  // radians

// The plane seen from in front: +1 where the surface is, -1 where the camera looks
// through to something behind, 0 where nothing is known.
struct Rectified {
    int side = 0;  // cells in a row and in a column
    std::vector<std::int8_t> value;

    int at(int x, int y) const {
        return value[std::size_t(y) * std::size_t(side) + std::size_t(x)];
    }
};

// Axes on the plane, unit vectors in the camera's frame.
struct Axes {
    Vec3 origin, x, y, z;
};

Axes axes_on(const Plane& plane, Vec3 middle) {
    const Vec3 z = plane.normal();
    const Vec3 helper = std::abs(z.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 x = normalized(helper - z * dot(helper, z));
    // On the plane itself, where the mean of noisy points is not quite.
    const Vec3 origin = middle + z * ((1 - dot(plane.q, middle)) / -length(plane.q));
    return {origin, x, cross(z, x), z};
}

Axes turned(const Axes& a, double angle) {
    const Vec3 x = a.x * std::cos(angle) + a.y * std::sin(angle);
    return {a.origin, x, cross(a.z, x), a.z};
}

Rectified rectify(const DepthLookup& lookup, const Axes& axes, double reach_m) {
    Rectified picture;
    picture.side = 2 * int(std::ceil(reach_m / cell_m));
    picture.value.assign(std::size_t(picture.side) * std::size_t(picture.side), 0);
    const double first = (0.5 - picture.side / 2) * cell_m;
    for (int j = 0; j < picture.side; ++j)
        for (int i = 0; i < picture.side; ++i) {
            const Vec3 p =
                axes.origin + axes.x * (first + i * cell_m) + axes.y * (first + j * cell_m);
            const auto pixel = project(*lookup.camera, p);
            if (!pixel)
                continue;
            const int px = int(std::lround(pixel->x)), py = int(std::lround(pixel->y));
            if (px < 0 || py < 0 || px >= lookup.depth.size.width || py >= lookup.depth.size.height)
                continue;
            const double measured = lookup.depth.row(py)[px] * lookup.metres_per_unit;
            if (measured == 0)
                continue;
            const double behind = (measured - p.z) * -dot(axes.z, p) / p.z;
            const double tolerance = plane_tolerance_m(p.z);
            std::int8_t& value =
                picture.value[std::size_t(j) * std::size_t(picture.side) + std::size_t(i)];
            if (std::abs(behind) <= tolerance)
                value = 1;
            else if (behind > 2 * tolerance)
                value = -1;
        }
    return picture;
}

// The same picture for axes that are turned by a quarter, counter-clockwise.
Rectified quarter_turned(const Rectified& picture) {
    Rectified result{picture.side, std::vector<std::int8_t>(picture.value.size())};
    const int side = picture.side;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            result.value[std::size_t(y) * std::size_t(side) + std::size_t(x)] =
                std::int8_t(picture.at(side - 1 - y, x));
    return result;
}

// The direction of the pattern's edges, within an eighth of a turn of the x axis.
double edge_angle(const Rectified& picture) {
    double cosine = 0, sine = 0;
    // Nothing is known along edges for some centimetres: a window reaches across.
    constexpr int arm = 3;
    for (int y = arm; y + arm < picture.side; ++y)
        for (int x = arm; x + arm < picture.side; ++x) {
            int gx = 0, gy = 0, least = 0, largest = 0;
            for (int k = -arm; k <= arm; ++k) {
                const int left = picture.at(x - arm, y + k), right = picture.at(x + arm, y + k);
                const int below = picture.at(x + k, y - arm), above = picture.at(x + k, y + arm);
                gx += right - left;
                gy += above - below;
                least = std::min({least, left, right, below, above});
                largest = std::max({largest, left, right, below, above});
            }
            // Beside what is not measured at all there is no edge of the board.
            if (least == largest || least == 0 || largest == 0)
                continue;
            // Four times the angle is the same for all four directions of a rectangle's edges.
            const double angle = 4 * std::atan2(double(gy), double(gx));
            const double weight = gx * gx + gy * gy;
            cosine += weight * std::cos(angle);
            sine += weight * std::sin(angle);
        }
    return std::atan2(sine, cosine) / 4;
}

// Sums over any rectangle in four look-ups.
class Integral {
public:
    Integral(const Rectified& picture, bool absolute) : side_(picture.side + 1) {
        sums_.assign(std::size_t(side_) * std::size_t(side_), 0);
        for (int y = 0; y < picture.side; ++y) {
            int row = 0;
            for (int x = 0; x < picture.side; ++x) {
                row += absolute ? std::abs(picture.at(x, y)) : picture.at(x, y);
                at(x + 1, y + 1) = at(x + 1, y) + row;
            }
        }
    }
    int sum(int left, int bottom, int right, int top) const {
        const auto get = [&](int x, int y) {
            x = std::clamp(x, 0, side_ - 1);
            y = std::clamp(y, 0, side_ - 1);
            return sums_[std::size_t(y) * std::size_t(side_) + std::size_t(x)];
        };
        return get(right, top) - get(left, top) - get(right, bottom) + get(left, bottom);
    }

private:
    int& at(int x, int y) { return sums_[std::size_t(y) * std::size_t(side_) + std::size_t(x)]; }

    int side_;
    std::vector<int> sums_;
};

struct CellRect {
    int left, bottom, right, top;

    int area() const { return (right - left) * (top - bottom); }
};

CellRect in_cells(const Rect& r, double grow_m = 0) {
    const auto round = [](double v) { return int(std::lround(v / cell_m)); };
    return {round(r.left - grow_m), round(r.bottom - grow_m), round(r.right + grow_m),
            round(r.top + grow_m)};
}

constexpr int columns = LatticeTarget::columns, rows = LatticeTarget::rows;

// The four ways to see the board with its long side along the picture's x.
struct Way {
    Face face = Face::front;
    bool upside_down = false;
    bool operator==(const Way&) const = default;

    bool is_filled_at(int column, int row) const {
        return upside_down ? is_filled(face, columns - 1 - column, rows - 1 - row)
                           : is_filled(face, column, row);
    }
};
constexpr std::array<Way, 4> ways{
    {{Face::front, false}, {Face::front, true}, {Face::back, false}, {Face::back, true}}};

struct Place {
    int x = 0, y = 0;  // of the board's middle, cells from the picture's
    Way way;
    int score = -1 << 30;  // cells that agree minus cells that do not
};

// Compares the pattern with the picture at any place.
class Comparison {
public:
    Comparison(const Rectified& picture, const LatticeTarget& target)
        : values_(picture, false),
          known_(picture, true),
          middle_(picture.side / 2),
          outer_(in_cells(outline(target))),
          rim_(in_cells(outline(target), rim_m)) {
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column)
                cells_[std::size_t(row * columns + column)] = in_cells(cell(target, column, row));
    }

    // Scores of the four ways.
    std::array<int, ways.size()> scores(int x, int y) const {
        std::array<int, cell_count> content{};
        for (std::size_t i = 0; i < cell_count; ++i)
            content[i] = sum(values_, cells_[i], x, y);
        // The face minus the rim around it, as if there were no holes.
        const int solid = 2 * sum(values_, outer_, x, y) - sum(values_, rim_, x, y);
        std::array<int, ways.size()> result{};
        for (std::size_t w = 0; w < ways.size(); ++w) {
            result[w] = solid;
            for (int row = 0; row < rows; ++row)
                for (int column = 0; column < columns; ++column)
                    if (!ways[w].is_filled_at(column, row))
                        result[w] -= 2 * content[std::size_t(row * columns + column)];
        }
        return result;
    }

    Place best(int x0, int y0, int reach, int step) const {
        Place best;
        for (int y = y0 - reach; y <= y0 + reach; y += step)
            for (int x = x0 - reach; x <= x0 + reach; x += step) {
                const auto all = scores(x, y);
                for (std::size_t w = 0; w < ways.size(); ++w)
                    if (all[w] > best.score)
                        best = {x, y, ways[w], all[w]};
            }
        return best;
    }

    int known(const Place& place) const { return sum(known_, rim_, place.x, place.y); }
    int total() const { return rim_.area(); }

private:
    static constexpr std::size_t cell_count = std::size_t(columns) * std::size_t(rows);

    int sum(const Integral& image, const CellRect& r, int x, int y) const {
        return image.sum(middle_ + x + r.left, middle_ + y + r.bottom, middle_ + x + r.right,
                         middle_ + y + r.top);
    }

    Integral values_, known_;
    int middle_;
    CellRect outer_, rim_;
    std::array<CellRect, cell_count> cells_{};
};

std::optional<LatticeMatch> match_upright(const Rectified& picture, const Axes& axes,
                                          const LatticeTarget& target) {
    const Comparison comparison(picture, target);
    constexpr int coarse = 3;
    const Place rough = comparison.best(0, 0, int(search_m / cell_m), coarse);
    const Place place = comparison.best(rough.x, rough.y, coarse, 1);
    const double known = comparison.known(place);
    if (known < least_known * comparison.total())
        return {};
    int other = -1 << 30;
    const auto all = comparison.scores(place.x, place.y);
    for (std::size_t w = 0; w < ways.size(); ++w)
        if (!(ways[w] == place.way))
            other = std::max(other, all[w]);

    LatticeMatch match;
    match.face = place.way.face;
    match.agreement = 0.5 + 0.5 * place.score / known;
    match.known = known / comparison.total();
    match.margin = 0.5 * (place.score - other) / known;
    if (match.agreement < least_agreement || match.margin < least_margin)
        return {};
    const Vec3 origin = axes.origin + axes.x * (place.x * cell_m) + axes.y * (place.y * cell_m);
    const double sign = place.way.upside_down ? -1 : 1;
    const Vec3 x = axes.x * sign, y = axes.y * sign, z = axes.z;
    match.camera_from_face = {
        quat_from_matrix({{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}}), origin};
    return match;
}

}  // namespace

std::optional<LatticeMatch> match_lattice(const DepthLookup& depth, const FoundPlane& found,
                                          const LatticeTarget& target) {
    const double half_diagonal = std::hypot(target.width_m, target.height_m) / 2;
    const double reach_m = half_diagonal + search_m;
    Axes axes = axes_on(found.plane, found.middle);
    Rectified picture = rectify(depth, axes, reach_m);
    // Cells make directions other than their own inaccurate, so the picture is made again.
    for (int i = 0; i < most_turns; ++i) {
        const double angle = edge_angle(picture);
        if (std::abs(angle) < straight_enough)
            break;
        axes = turned(axes, angle);
        picture = rectify(depth, axes, reach_m);
    }
    // The pattern is upright in one of two pictures, a quarter turn apart.
    const auto upright = match_upright(picture, axes, target);
    const auto lying =
        match_upright(quarter_turned(picture), turned(axes, std::numbers::pi / 2), target);
    return lying && (!upright || lying->agreement > upright->agreement) ? lying : upright;
}

}  // namespace theatron::registration
