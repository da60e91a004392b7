// SPDX-License-Identifier: Apache-2.0
// The lattice target: a flat board with rectangular holes that is found in depth
// images alone.
//
// The bars between the holes are equally wide. Three cells of one corner are not
// cut out, so that the four ways to see the board (two faces, each upright or
// upside down) all look different and the pose is never ambiguous. After the
// lattice board of Muehlenbrock et al., "Fast, Accurate and Robust Registration
// of Multiple Depth Sensors without need for RGB and IR Images" (The Visual
// Computer, 2022), with another pattern.
//
// Board frame: metres, origin in the middle of the front face, x along the long
// side, y up, z out of the front face. The back face lies at z = -thickness_m.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/vec.h"

namespace theatron::registration {

// An axis-aligned rectangle on a face of the board, metres.
struct Rect {
    double left = 0, bottom = 0, right = 0, top = 0;
    double width() const { return right - left; }
    double height() const { return top - bottom; }
    double area() const { return width() * height(); }
    bool operator==(const Rect&) const = default;
};

struct LatticeTarget {
    static constexpr int columns = 4, rows = 3;

    double width_m = 0.8, height_m = 0.6;
    double bar_m = 0.06;
    double thickness_m = 0.01;

    bool operator==(const LatticeTarget&) const = default;
};

// 60 x 80 cm, for rooms; and the sheet size A2, for short distances.
LatticeTarget large_target();
LatticeTarget a2_target();

// The board's two faces. Each has a frame of its own: x along the long side, y
// up, z out of that face; the back's x runs against the board's x.
enum class Face : std::uint8_t { front, back };

Pose board_from_face(const LatticeTarget& target, Face face);

// Outline of either face, in its frame.
Rect outline(const LatticeTarget& target);

// Cell (column, row) of either face, columns from the left, rows from the top.
Rect cell(const LatticeTarget& target, int column, int row);

// True if this cell is not cut out. Columns and rows are as seen from `face`.
bool is_filled(Face face, int column, int row);

// All cells that are cut out, seen from `face`.
std::vector<Rect> holes(const LatticeTarget& target, Face face);

// The pattern of one face, prepared to be asked about many places.
class FacePattern {
public:
    FacePattern(const LatticeTarget& target, Face face);

    static constexpr int cell_count = LatticeTarget::columns * LatticeTarget::rows;

    // The cell nearest to a place on the face, row by row.
    int nearest_cell(double u, double v) const {
        const auto index = [](double along, int count) {
            return int(std::clamp(along, 0.0, double(count - 1)) + 0.5);
        };
        return index((first_v_ - v) * per_step_v_, LatticeTarget::rows) * LatticeTarget::columns +
               index((u - first_u_) * per_step_u_, LatticeTarget::columns);
    }
    bool is_hole(int cell_index) const { return holes_[std::size_t(cell_index)]; }
    const Rect& cell_at(int cell_index) const { return cells_[std::size_t(cell_index)]; }

    // How far a place lies inside the outline, and inside the nearest hole; metres along the nearer
    // axis, negative outside.
    struct Inside {
        double outline = 0, hole = 0;
        double solid() const { return std::min(outline, -hole); }
        double edge() const { return std::min(std::abs(outline), std::abs(hole)); }
    };
    Inside inside(double u, double v) const {
        constexpr double no_hole = -1e3;
        const int i = nearest_cell(u, v);
        const Rect& c = cells_[std::size_t(i)];
        return {std::min(half_width_ - std::abs(u), half_height_ - std::abs(v)),
                holes_[std::size_t(i)]
                    ? std::min(std::min(u - c.left, c.right - u), std::min(v - c.bottom, c.top - v))
                    : no_hole};
    }

    // The side of the outline that a place outside of it is beyond: left, bottom, right, top.
    int side_beyond(double u, double v) const {
        const std::array<double, 4> beside{-half_width_ - u, -half_height_ - v, u - half_width_,
                                           v - half_height_};
        return int(std::max_element(beside.begin(), beside.end()) - beside.begin());
    }

private:
    double half_width_, half_height_;
    double first_u_, first_v_, per_step_u_, per_step_v_;  // middles of cells
    std::array<Rect, cell_count> cells_;
    std::array<bool, cell_count> holes_{};
};

// Area of one face without its holes, square metres.
double solid_area_m2(const LatticeTarget& target);

// False for sizes that leave no holes, or numbers that are not finite and positive.
bool is_valid(const LatticeTarget& target);

}  // namespace theatron::registration
