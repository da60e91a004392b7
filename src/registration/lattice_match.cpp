// SPDX-License-Identifier: Apache-2.0
#include "registration/lattice_match.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace theatron::registration {
namespace {

constexpr double rim_m = 0.04;  // around the outline nothing may lie on the plane
constexpr double least_known = 0.5;
constexpr double half_known = 0.65;  // below, the agreement has to be twice as good

// The coarse picture rules out most planes.
struct Stage {
    double cell_m;
    int arm;                 // of edge_angle
    int most_turns;          // until the picture is upright
    double straight_enough;  // radians
    double search_m;         // between the origin of the axes and the middle of the board
    int search_step;         // cells
    double least_agreement, least_margin;
};
constexpr Stage coarse{0.02, 2, 2, 0.02, 0.3, 2, 0.78, 0.03};
constexpr Stage fine{0.01, 3, 2, 0.006, 0.03, 1, 0.9, 0.06};

// Sums over any rectangle in four look-ups.
class Integral {
public:
    Integral(const Rectified& picture, bool absolute) : side_(picture.side + 1) {
        sums_.assign(std::size_t(side_) * std::size_t(side_), 0);
        for (int y = 0; y < picture.side; ++y) {
            int row = 0;
            for (int x = 0; x < picture.side; ++x) {
                const int value = picture.row(y)[x];
                row += absolute ? std::abs(value) : value;
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

CellRect in_cells(const Rect& r, double cell_m, double grow_m = 0) {
    const auto round = [&](double v) { return int(std::lround(v / cell_m)); };
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
    Comparison(const Rectified& picture, const LatticeTarget& target, double cell_m)
        : values_(picture, false),
          known_(picture, true),
          middle_(picture.side / 2),
          outer_(in_cells(outline(target), cell_m)),
          rim_(in_cells(outline(target), cell_m, rim_m)) {
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column)
                cells_[std::size_t(row * columns + column)] =
                    in_cells(cell(target, column, row), cell_m);
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

std::optional<LatticeMatch> match_upright(const Rectified& picture, const PlaneAxes& axes,
                                          const LatticeTarget& target, const Stage& stage) {
    const double cell_m = stage.cell_m;
    const Comparison comparison(picture, target, cell_m);
    const Place rough = comparison.best(0, 0, int(stage.search_m / cell_m), stage.search_step);
    const Place place =
        stage.search_step > 1 ? comparison.best(rough.x, rough.y, stage.search_step, 1) : rough;
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
    const double least_agreement = match.known < half_known
                                       ? stage.least_agreement + (1 - stage.least_agreement) / 2
                                       : stage.least_agreement;
    if (match.agreement < least_agreement || match.margin < stage.least_margin)
        return {};
    const Vec3 origin = axes.origin + axes.x * (place.x * cell_m) + axes.y * (place.y * cell_m);
    const double sign = place.way.upside_down ? -1 : 1;
    const Vec3 x = axes.x * sign, y = axes.y * sign, z = axes.z;
    match.camera_from_face = {
        quat_from_matrix({{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}}), origin};
    return match;
}

// The pattern along the axes of a picture that is turned until it is upright.
std::optional<LatticeMatch> match_in(const DepthLookup& depth, PlaneAxes axes,
                                     const LatticeTarget& target, const Stage& stage) {
    const double reach_m = std::hypot(target.width_m, target.height_m) / 2 + rim_m + stage.search_m;
    Rectified picture = rectify(depth, axes, reach_m, stage.cell_m);
    // Cells make directions other than their own inaccurate, so the picture is made again.
    for (int i = 0; i < stage.most_turns; ++i) {
        const double angle = edge_angle(picture, stage.arm);
        if (std::abs(angle) < stage.straight_enough)
            break;
        axes = turned(axes, angle);
        picture = rectify(depth, axes, reach_m, stage.cell_m);
    }
    const auto upright = match_upright(picture, axes, target, stage);
    // The other of the two directions that edges have.
    const auto lying =
        match_upright(quarter_turned(picture), turned(axes, std::numbers::pi / 2), target, stage);
    return lying && (!upright || lying->agreement > upright->agreement) ? lying : upright;
}

}  // namespace

std::optional<LatticeMatch> match_lattice(const DepthLookup& depth, const FoundPlane& found,
                                          const LatticeTarget& target) {
    const auto rough = match_in(depth, axes_on(found.plane, found.middle), target, coarse);
    if (!rough)
        return {};
    const Mat3 m = matrix_from_quat(rough->camera_from_face.rotation);
    const auto axis = [&](int i) { return Vec3{m.m[0][i], m.m[1][i], m.m[2][i]}; };
    return match_in(depth, {rough->camera_from_face.translation, axis(0), axis(1), axis(2)}, target,
                    fine);
}

}  // namespace theatron::registration
