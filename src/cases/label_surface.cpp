// SPDX-License-Identifier: Apache-2.0
#include "cases/label_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "medical/isosurface.h"
#include "medical/mesh_shaping.h"

namespace theatron::cases {
namespace {

using medical::Mesh;
using medical::VolumeGrid;

// Rounds of smoothing. They take away the steps of pixels; those of slices that are several times
// as far apart become lower only.
constexpr int smoothing_rounds = 25;

// A block of samples, ends excluded.
struct Block {
    int first[3] = {1 << 30, 1 << 30, 1 << 30};
    int end[3] = {0, 0, 0};
    std::size_t samples = 0;
};

Block block_of(const LabelMap& map, int value) {
    Block block;
    const VolumeGrid& grid = map.grid;
    std::size_t i = 0;
    for (int k = 0; k < grid.slices; ++k)
        for (int j = 0; j < grid.rows; ++j)
            for (int c = 0; c < grid.columns; ++c, ++i) {
                if (map.labels[i] != value)
                    continue;
                const int place[3] = {c, j, k};
                for (int axis = 0; axis < 3; ++axis) {
                    block.first[axis] = std::min(block.first[axis], place[axis]);
                    block.end[axis] = std::max(block.end[axis], place[axis] + 1);
                }
                ++block.samples;
            }
    return block;
}

// The block with a margin of one sample, so that the surface closes also at the map's border.
VolumeGrid grid_of(const VolumeGrid& grid, const Block& block) {
    VolumeGrid part = grid;
    part.columns = block.end[0] - block.first[0] + 2;
    part.rows = block.end[1] - block.first[1] + 2;
    part.slices = block.end[2] - block.first[2] + 2;
    part.origin_mm =
        grid.point_at(block.first[0] - 1.0, block.first[1] - 1.0, block.first[2] - 1.0);
    return part;
}

bool has_label(const LabelMap& map, int value, int column, int row, int slice) {
    const VolumeGrid& grid = map.grid;
    return column >= 0 && column < grid.columns && row >= 0 && row < grid.rows && slice >= 0 &&
           slice < grid.slices && map.labels[grid.index(column, row, slice)] == value;
}

// The share of a sample's surroundings that lacks the label, less a half, weighted 1-2-1 along each
// axis: steps between samples become slopes. Its sign stays that of the sample itself, so that
// nothing thin is lost and nothing apart is joined.
float soft_side(const LabelMap& map, int value, int column, int row, int slice) {
    int sum = 0;
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                if (has_label(map, value, column + x, row + y, slice + z))
                    sum += (2 - std::abs(x)) * (2 - std::abs(y)) * (2 - std::abs(z));
    const float side = 0.5f - float(sum) / 64;
    constexpr float least = 0.1f;
    return has_label(map, value, column, row, slice) ? std::min(side, -least)
                                                     : std::max(side, least);
}

}  // namespace

std::vector<LabelCount> labels_in(const LabelMap& map) {
    std::vector<std::size_t> counts(65536);
    for (const std::uint16_t label : map.labels)
        ++counts[label];
    std::vector<LabelCount> found;
    for (int value = 1; value < 65536; ++value)
        if (counts[std::size_t(value)] > 0)
            found.push_back({value, counts[std::size_t(value)]});
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

Mesh surface_of_label(const LabelMap& map, int value, std::size_t max_triangles,
                      const std::function<void()>& between_steps) {
    const Block block = block_of(map, value);
    if (block.samples == 0)
        return {};
    const VolumeGrid grid = grid_of(map.grid, block);
    const auto field = [&](int slice, std::span<float> out) {
        between_steps();
        for (int j = 0; j < grid.rows; ++j)
            for (int c = 0; c < grid.columns; ++c)
                out[std::size_t(j) * std::size_t(grid.columns) + std::size_t(c)] =
                    soft_side(map, value, block.first[0] + c - 1, block.first[1] + j - 1,
                              block.first[2] + slice - 1);
    };
    Mesh mesh = medical::isosurface(grid, field);
    if (mesh.triangles.empty())
        return mesh;
    const double volume = double(block.samples) * sample_volume_mm3(map.grid);
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
