// SPDX-License-Identifier: Apache-2.0
#include "cases/label_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "medical/isosurface.h"
#include "medical/mesh_shaping.h"

namespace theatron::cases {
namespace {

using medical::Mesh;
using medical::VolumeGrid;

// Rounds of smoothing. They take away the steps of pixels; those of slices that are several times
// as far apart become lower only.
constexpr int smoothing_rounds = 25;

// The block with a margin of one sample, so that the surface closes also at the map's border.
VolumeGrid grid_of(const VolumeGrid& grid, const LabelCount& block) {
    VolumeGrid part = grid;
    part.columns = block.end[0] - block.first[0] + 2;
    part.rows = block.end[1] - block.first[1] + 2;
    part.slices = block.end[2] - block.first[2] + 2;
    part.origin_mm =
        grid.point_at(block.first[0] - 1.0, block.first[1] - 1.0, block.first[2] - 1.0);
    return part;
}

// The share of a sample's surroundings that lacks the label, less a half, weighted 1-2-1 along each
// axis: steps between samples become slopes. Its sign stays that of the sample itself, so that
// nothing thin is lost and nothing apart is joined.
class SoftSides {
public:
    SoftSides(const LabelMap& map, const LabelCount& label, const VolumeGrid& grid)
        : map_(map), label_(label), grid_(grid) {}

    // Writes the layer `slice` of the grid.
    void write(int slice, std::span<float> out) {
        const Layer &below = layer(slice - 1), &here = layer(slice), &above = layer(slice + 1);
        constexpr float least = 0.1f;
        for (std::size_t i = 0; i < out.size(); ++i) {
            const int sum = below.sums[i] + 2 * here.sums[i] + above.sums[i];
            const float side = 0.5f - float(sum) / 64;
            out[i] = here.has[i] ? std::min(side, -least) : std::max(side, least);
        }
    }

private:
    struct Layer {
        std::optional<int> slice;
        std::vector<std::uint8_t> has, sums;  // weighted 1-2-1 along columns and rows
    };

    // The newest three are kept.
    const Layer& layer(int slice) {
        Layer& layer = layers_[std::size_t(slice + 3) % 3];
        if (layer.slice == slice)
            return layer;
        layer.slice = slice;
        layer.has.assign(std::size_t(grid_.columns) * std::size_t(grid_.rows), 0);
        layer.sums.assign(layer.has.size(), 0);
        if (slice < 1 || slice > label_.end[2] - label_.first[2])
            return layer;
        for (int row = 1; row < grid_.rows - 1; ++row) {
            const std::uint16_t* const labels = &map_.labels[map_.grid.index(
                label_.first[0], label_.first[1] + row - 1, label_.first[2] + slice - 1)];
            for (int column = 1; column < grid_.columns - 1; ++column)
                if (labels[column - 1] == label_.value)
                    add(layer, std::size_t(row) * std::size_t(grid_.columns) + std::size_t(column));
        }
        return layer;
    }

    void add(Layer& layer, std::size_t place) const {
        layer.has[place] = 1;
        const auto columns = std::size_t(grid_.columns);
        for (const std::size_t middle : {place - columns, place, place + columns}) {
            const int weight = middle == place ? 2 : 1;
            layer.sums[middle - 1] = std::uint8_t(layer.sums[middle - 1] + weight);
            layer.sums[middle] = std::uint8_t(layer.sums[middle] + 2 * weight);
            layer.sums[middle + 1] = std::uint8_t(layer.sums[middle + 1] + weight);
        }
    }

    const LabelMap& map_;
    const LabelCount& label_;
    const VolumeGrid& grid_;
    Layer layers_[3];
};

}  // namespace

std::vector<LabelCount> labels_in(const LabelMap& map) {
    std::vector<LabelCount> all(65536);
    const VolumeGrid& grid = map.grid;
    std::size_t i = 0;
    for (int slice = 0; slice < grid.slices; ++slice)
        for (int row = 0; row < grid.rows; ++row)
            for (int column = 0; column < grid.columns; ++column, ++i) {
                if (map.labels[i] == 0)
                    continue;
                LabelCount& label = all[map.labels[i]];
                const int place[3] = {column, row, slice};
                for (int axis = 0; axis < 3; ++axis) {
                    label.first[axis] = std::min(label.first[axis], place[axis]);
                    label.end[axis] = std::max(label.end[axis], place[axis] + 1);
                }
                ++label.samples;
            }
    std::vector<LabelCount> found;
    for (int value = 1; value < 65536; ++value)
        if (all[std::size_t(value)].samples > 0) {
            found.push_back(all[std::size_t(value)]);
            found.back().value = value;
        }
    return found;
}

bool looks_like_an_image(const LabelMap& map) {
    constexpr std::size_t many_values = 40, least_pairs = 1000;
    constexpr double equal_neighbours = 0.35;
    if (labels_in(map).size() < many_values)
        return false;
    const VolumeGrid& grid = map.grid;
    const std::size_t row = std::size_t(grid.columns), slice = row * std::size_t(grid.rows);
    const std::size_t steps[] = {1, row, slice};
    double least_share = 1;
    // Pairs at the ends of rows and slices are too few to matter.
    for (const std::size_t step : steps) {
        std::size_t pairs = 0, equal = 0;
        for (std::size_t i = step; i < map.labels.size(); ++i)
            if (map.labels[i] != 0 && map.labels[i - step] != 0) {
                ++pairs;
                equal += map.labels[i] == map.labels[i - step];
            }
        if (pairs >= least_pairs)
            least_share = std::min(least_share, double(equal) / double(pairs));
    }
    return least_share < equal_neighbours;
}

double sample_volume_mm3(const VolumeGrid& grid) {
    return std::abs(dot(grid.column_step_mm, cross(grid.row_step_mm, grid.slice_step_mm)));
}

Mesh surface_of_label(const LabelMap& map, const LabelCount& label, std::size_t max_triangles,
                      SurfaceBudget& budget, const std::function<void()>& between_steps) {
    const VolumeGrid grid = grid_of(map.grid, label);
    if (grid.size() > budget.samples)
        return {};
    budget.samples -= grid.size();
    SoftSides sides(map, label, grid);
    const auto field = [&](int slice, std::span<float> out) {
        between_steps();
        sides.write(slice, out);
    };
    Mesh mesh =
        medical::isosurface(grid, field, std::min(medical::max_mesh_triangles, budget.triangles));
    if (mesh.triangles.empty())
        return mesh;
    budget.triangles -= mesh.triangles.size();
    const double volume = double(label.samples) * sample_volume_mm3(map.grid);
    between_steps();
    medical::smooth(mesh, smoothing_rounds);
    medical::restore_volume(mesh, volume);
    between_steps();
    medical::simplify(mesh, max_triangles);
    medical::restore_volume(mesh, volume);
    medical::compute_normals(mesh);
    return mesh;
}

}  // namespace theatron::cases
