// SPDX-License-Identifier: Apache-2.0
// How much of the light along a cone arrives: voxel cone tracing (Crassin et al. 2011) through the
// share of each cell that is filled, at several sizes of cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "furniture/extent.h"
#include "furniture/model.h"

namespace theatron::furniture {

class Voxels {
public:
    // Empty, with cells of 5 cm; larger ones where there would be more than two million.
    explicit Voxels(const Extent& extent);

    // Fills cells at these triangles' surfaces.
    void add(const render::MeshData& mesh, const Pose& room_from_mesh);
    // To be called after the last add() and before open_share(), until it returns true: each call
    // takes a few milliseconds.
    bool finish_step();

    // The share of a cone from `from` in direction `d` (unit length) that is open up to `reach_m`.
    // `slope`: radius of the cone at a distance of 1. Starts `lift_m` away from `from`.
    double open_share(Vec3 from, Vec3 d, double slope, double reach_m, double lift_m) const;
    double cell_m() const { return cell_m_; }

private:
    static constexpr int level_count = 5;
    struct Level {
        int nx = 0, ny = 0, nz = 0;
        std::vector<float> filled;
        float at(int x, int y, int z) const {
            if (x < 0 || y < 0 || z < 0 || x >= nx || y >= ny || z >= nz)
                return 0;
            return filled[(std::size_t(z) * std::size_t(ny) + std::size_t(y)) * std::size_t(nx) +
                          std::size_t(x)];
        }
    };
    double filled_at(Vec3 place, int level) const;

    std::size_t level_done_ = 0;  // by finish_step()
    int layers_done_ = 0;         // of the next level
    Vec3 low_;
    double cell_m_ = 0.05;
    std::array<Level, level_count> levels_;
};

}  // namespace theatron::furniture
