// SPDX-License-Identifier: Apache-2.0
#include "medical/isosurface.h"

#include <algorithm>
#include <cmath>

namespace theatron::medical {
namespace {

constexpr std::uint32_t none = 0xffffffff;

// A corner of a cell as bits: 1 one column on, 2 one row on, 4 one slice on.
using Corner = unsigned;

// The six tetrahedra of a cell, all around the diagonal from corner 0 to 7, each turned the same
// way.
constexpr Corner tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7},
                                     {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 6, 4, 7}};

// For each set of corners inside, as bits: the corners in an order that is turned as the
// tetrahedron is, those inside first; and how many are inside.
struct Split {
    int inside;
    int order[4];
};
constexpr Split splits[16] = {
    {0, {0, 1, 2, 3}}, {1, {0, 1, 2, 3}}, {1, {1, 0, 3, 2}}, {2, {0, 1, 2, 3}},
    {1, {2, 0, 1, 3}}, {2, {0, 2, 3, 1}}, {2, {1, 2, 0, 3}}, {3, {0, 1, 2, 3}},
    {1, {3, 0, 2, 1}}, {2, {0, 3, 1, 2}}, {2, {1, 3, 2, 0}}, {3, {0, 3, 1, 2}},
    {2, {2, 3, 0, 1}}, {3, {0, 2, 3, 1}}, {3, {1, 3, 2, 0}}, {4, {0, 1, 2, 3}}};

class Builder {
public:
    Builder(const VolumeGrid& grid, std::size_t max_triangles)
        : grid_(grid),
          max_triangles_(max_triangles),
          layer_(std::size_t(grid.columns) * std::size_t(grid.rows)) {
        for (int i = 0; i < 2; ++i) {
            values_[i].resize(layer_);
            edges_[i].assign(7 * layer_, none);
        }
        const Vec3 across = cross(grid.column_step_mm, grid.row_step_mm);
        mirrored_ = dot(across, grid.slice_step_mm) < 0;
    }

    Mesh run(const FieldLayer& field) {
        load(field, 0, values_[0]);
        for (slice_ = 0; slice_ + 1 < grid_.slices; ++slice_) {
            load(field, slice_ + 1, values_[1]);
            for (int row = 0; row + 1 < grid_.rows; ++row)
                for (int column = 0; column + 1 < grid_.columns; ++column)
                    add_cell(column, row);
            if (mesh_.triangles.size() > max_triangles_)
                return {};
            std::swap(values_[0], values_[1]);
            std::swap(edges_[0], edges_[1]);
            std::fill(edges_[1].begin(), edges_[1].end(), none);
        }
        return std::move(mesh_);
    }

private:
    void load(const FieldLayer& field, int slice, std::vector<float>& out) const {
        const bool outermost = slice == 0 || slice + 1 == grid_.slices;
        if (outermost) {
            std::fill(out.begin(), out.end(), 1.0f);
            return;
        }
        field(slice, out);
        const auto columns = std::size_t(grid_.columns);
        std::fill_n(out.begin(), columns, 1.0f);
        std::fill_n(out.end() - std::ptrdiff_t(columns), columns, 1.0f);
        for (std::size_t row = 0; row < std::size_t(grid_.rows); ++row)
            out[row * columns] = out[row * columns + columns - 1] = 1;
    }

    std::size_t place(int column, int row, Corner corner) const {
        return std::size_t(row + int(corner >> 1 & 1)) * std::size_t(grid_.columns) +
               std::size_t(column + int(corner & 1));
    }
    float value(int column, int row, Corner corner) const {
        return values_[corner >> 2][place(column, row, corner)];
    }

    void add_cell(int column, int row) {
        unsigned inside = 0;
        for (Corner corner = 0; corner < 8; ++corner)
            inside |= unsigned(value(column, row, corner) < 0) << corner;
        if (inside == 0 || inside == 255)
            return;
        for (const Corner(&corners)[4] : tetrahedra) {
            unsigned mask = 0;
            for (unsigned i = 0; i < 4; ++i)
                mask |= (inside >> corners[i] & 1) << i;
            add_tetrahedron(column, row, corners, splits[mask]);
        }
    }

    void add_tetrahedron(int column, int row, const Corner (&corners)[4], const Split& split) {
        const auto cut = [&](int a, int b) {
            return vertex(column, row, corners[split.order[a]], corners[split.order[b]]);
        };
        if (split.inside == 1) {
            add(cut(0, 1), cut(0, 2), cut(0, 3));
        } else if (split.inside == 3) {
            add(cut(3, 0), cut(3, 1), cut(3, 2));
        } else if (split.inside == 2) {
            const std::uint32_t ring[] = {cut(0, 2), cut(0, 3), cut(1, 3), cut(1, 2)};
            add(ring[0], ring[1], ring[2]);
            add(ring[0], ring[2], ring[3]);
        }
    }

    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (mirrored_)
            std::swap(b, c);
        mesh_.triangles.push_back({a, b, c});
    }

    // The vertex on the edge between two corners, one for all cells around the edge.
    std::uint32_t vertex(int column, int row, Corner a, Corner b) {
        if (a > b)
            std::swap(a, b);  // corners of an edge are subsets of each other, so a is the lower one
        std::uint32_t& known = edges_[a >> 2][7 * place(column, row, a) + (a ^ b) - 1];
        if (known == none) {
            const float at_a = value(column, row, a), at_b = value(column, row, b);
            // Off the samples themselves, where vertices of several edges would meet.
            const double share =
                std::clamp(double(at_a) / (double(at_a) - double(at_b)), 0.01, 0.99);
            known = std::uint32_t(mesh_.positions.size());
            mesh_.positions.push_back(
                to_float(point(column, row, a) * (1 - share) + point(column, row, b) * share));
        }
        return known;
    }

    Vec3 point(int column, int row, Corner corner) const {
        return grid_.point_at(column + int(corner & 1), row + int(corner >> 1 & 1),
                              slice_ + int(corner >> 2 & 1));
    }

    VolumeGrid grid_;
    std::size_t max_triangles_;
    std::size_t layer_;  // samples of a layer
    bool mirrored_ = false;
    int slice_ = 0;  // the lower of the two layers
    std::vector<float> values_[2];
    std::vector<std::uint32_t> edges_[2];  // by lower corner and direction
    Mesh mesh_;
};

}  // namespace

Mesh isosurface(const VolumeGrid& grid, const FieldLayer& field, std::size_t max_triangles) {
    return Builder(grid, max_triangles).run(field);
}

}  // namespace theatron::medical
