// SPDX-License-Identifier: Apache-2.0
#include "registration/lattice_target.h"

#include <cassert>
#include <cmath>

namespace theatron::registration {
namespace {

// Seen from the front, row by row from the top. Turned upside down, or seen from
// behind, at least four cells differ.
constexpr bool filled_cells[LatticeTarget::rows][LatticeTarget::columns] = {
    {true, true, false, false}, {true, false, false, false}, {false, false, false, false}};

constexpr double least_hole_m = 0.02;

double cell_width(const LatticeTarget& t) {
    return (t.width_m - (LatticeTarget::columns + 1) * t.bar_m) / LatticeTarget::columns;
}

double cell_height(const LatticeTarget& t) {
    return (t.height_m - (LatticeTarget::rows + 1) * t.bar_m) / LatticeTarget::rows;
}

}  // namespace

LatticeTarget large_target() {
    return {};
}

LatticeTarget a2_target() {
    return {.width_m = 0.594, .height_m = 0.420, .bar_m = 0.045, .thickness_m = 0.005};
}

Pose board_from_face(const LatticeTarget& target, Face face) {
    if (face == Face::front)
        return {};
    return {Quat{0, 0, 1, 0}, Vec3{0, 0, -target.thickness_m}};
}

Rect outline(const LatticeTarget& t) {
    return {-t.width_m / 2, -t.height_m / 2, t.width_m / 2, t.height_m / 2};
}

Rect cell(const LatticeTarget& t, int column, int row) {
    assert(column >= 0 && column < LatticeTarget::columns && row >= 0 && row < LatticeTarget::rows);
    const double left = -t.width_m / 2 + t.bar_m + column * (cell_width(t) + t.bar_m);
    const double top = t.height_m / 2 - t.bar_m - row * (cell_height(t) + t.bar_m);
    return {left, top - cell_height(t), left + cell_width(t), top};
}

bool is_filled(Face face, int column, int row) {
    return filled_cells[row][face == Face::front ? column : LatticeTarget::columns - 1 - column];
}

std::vector<Rect> holes(const LatticeTarget& target, Face face) {
    std::vector<Rect> result;
    for (int row = 0; row < LatticeTarget::rows; ++row)
        for (int column = 0; column < LatticeTarget::columns; ++column)
            if (!is_filled(face, column, row))
                result.push_back(cell(target, column, row));
    return result;
}

FacePattern::FacePattern(const LatticeTarget& target, Face face)
    : half_width_(target.width_m / 2), half_height_(target.height_m / 2) {
    for (int row = 0; row < LatticeTarget::rows; ++row)
        for (int column = 0; column < LatticeTarget::columns; ++column) {
            const auto i = std::size_t(row * LatticeTarget::columns + column);
            cells_[i] = cell(target, column, row);
            holes_[i] = !is_filled(face, column, row);
        }
    const Rect& first = cells_.front();
    const Rect& last = cells_.back();
    first_u_ = (first.left + first.right) / 2;
    first_v_ = (first.bottom + first.top) / 2;
    per_step_u_ = (LatticeTarget::columns - 1) / (last.left - first.left);
    per_step_v_ = (LatticeTarget::rows - 1) / (first.bottom - last.bottom);
}

double solid_area_m2(const LatticeTarget& target) {
    double area = target.width_m * target.height_m;
    for (const Rect& hole : holes(target, Face::front))
        area -= hole.area();
    return area;
}

bool is_valid(const LatticeTarget& t) {
    for (const double v : {t.width_m, t.height_m, t.bar_m, t.thickness_m})
        if (!std::isfinite(v) || v <= 0)
            return false;
    return cell_width(t) >= least_hole_m && cell_height(t) >= least_hole_m &&
           t.thickness_m < t.bar_m;
}

}  // namespace theatron::registration
