// SPDX-License-Identifier: Apache-2.0
#include "furniture/voxels.h"

#include <algorithm>
#include <cmath>

namespace theatron::furniture {

Voxels::Voxels(const Extent& e) : low_{e.left, 0, e.back} {
    const Vec3 size{e.right - e.left, e.height, e.front - e.back};
    constexpr double most_cells = 2e6;
    cell_m_ = std::max(cell_m_, std::cbrt(size.x * size.y * size.z / most_cells));
    int nx = int(std::ceil(size.x / cell_m_)), ny = int(std::ceil(size.y / cell_m_)),
        nz = int(std::ceil(size.z / cell_m_));
    for (Level& level : levels_) {
        level = {nx, ny, nz, {}};
        level.filled.resize(std::size_t(nx) * std::size_t(ny) * std::size_t(nz));
        nx = (nx + 1) / 2;
        ny = (ny + 1) / 2;
        nz = (nz + 1) / 2;
    }
}

void Voxels::add(const render::MeshData& mesh, const Pose& room_from_mesh) {
    Level& finest = levels_[0];
    const auto place = [&](std::uint32_t i) {
        const auto& v = mesh.vertices[i];
        return room_from_mesh * Vec3{v.px, v.py, v.pz};
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const Vec3 a = place(mesh.indices[i]), ab = place(mesh.indices[i + 1]) - a,
                   ac = place(mesh.indices[i + 2]) - a;
        const Vec3 n = cross(ab, ac);
        const double twice_area = length(n);
        if (twice_area < 1e-12)
            continue;
        // A little inside of the body, so that the cells before its surface stay empty.
        const Vec3 inwards = n * (-0.3 * cell_m_ / twice_area);
        const double longest = std::max({length(ab), length(ac), length(ac - ab)});
        const int steps = std::max(1, int(std::ceil(longest / (0.5 * cell_m_))));
        const double share = 0.5 * twice_area / (steps * steps) / (cell_m_ * cell_m_);
        for (int u = 0; u < steps; ++u)
            for (int v = 0; u + v < steps; ++v)
                for (int half = 0; half < (u + v + 1 < steps ? 2 : 1); ++half) {
                    const double third = half ? 2.0 / 3 : 1.0 / 3;
                    const Vec3 p = (a + ab * ((u + third) / steps) + ac * ((v + third) / steps) +
                                    inwards - low_) *
                                   (1 / cell_m_);
                    const int x = int(std::floor(p.x)), y = int(std::floor(p.y)),
                              z = int(std::floor(p.z));
                    if (x < 0 || y < 0 || z < 0 || x >= finest.nx || y >= finest.ny ||
                        z >= finest.nz)
                        continue;
                    float& cell =
                        finest.filled[(std::size_t(z) * std::size_t(finest.ny) + std::size_t(y)) *
                                          std::size_t(finest.nx) +
                                      std::size_t(x)];
                    cell = float(std::min(1.0, cell + share));
                }
    }
}

bool Voxels::finish_step() {
    constexpr std::size_t cells_at_once = 8192;
    if (level_done_ + 1 >= levels_.size())
        return true;
    const Level& fine = levels_[level_done_];
    Level& coarse = levels_[level_done_ + 1];
    const std::size_t layer = std::size_t(coarse.nx) * std::size_t(coarse.ny);
    std::size_t at = std::size_t(layers_done_) * layer;
    for (const std::size_t end = at + cells_at_once; at < end && layers_done_ < coarse.nz;
         ++layers_done_) {
        const int z = layers_done_;
        for (int y = 0; y < coarse.ny; ++y)
            for (int x = 0; x < coarse.nx; ++x) {
                float sum = 0;
                for (int i = 0; i < 8; ++i)
                    sum += fine.at(2 * x + (i & 1), 2 * y + ((i >> 1) & 1), 2 * z + (i >> 2));
                coarse.filled[at++] = sum / 8;
            }
    }
    if (layers_done_ == coarse.nz) {
        layers_done_ = 0;
        ++level_done_;
    }
    return level_done_ + 1 >= levels_.size();
}

double Voxels::filled_at(Vec3 place, int level) const {
    const Level& cells = levels_[std::size_t(level)];
    const double size = cell_m_ * (1 << level);
    const float px = float((place.x - low_.x) / size - 0.5),
                py = float((place.y - low_.y) / size - 0.5),
                pz = float((place.z - low_.z) / size - 0.5);
    const float fx = std::floor(px), fy = std::floor(py), fz = std::floor(pz);
    const int x = int(fx), y = int(fy), z = int(fz);
    const float u = px - fx, v = py - fy, w = pz - fz;
    const auto mixed = [](float a, float b, float share) { return a + (b - a) * share; };
    if (x < 0 || y < 0 || z < 0 || x + 1 >= cells.nx || y + 1 >= cells.ny || z + 1 >= cells.nz) {
        const auto along_x = [&](int yy, int zz) {
            return mixed(cells.at(x, yy, zz), cells.at(x + 1, yy, zz), u);
        };
        return mixed(mixed(along_x(y, z), along_x(y + 1, z), v),
                     mixed(along_x(y, z + 1), along_x(y + 1, z + 1), v), w);
    }
    const std::size_t row = std::size_t(cells.nx), layer = row * std::size_t(cells.ny);
    const float* c = &cells.filled[std::size_t(z) * layer + std::size_t(y) * row + std::size_t(x)];
    const auto along_x = [&](std::size_t at) { return mixed(c[at], c[at + 1], u); };
    return mixed(mixed(along_x(0), along_x(row), v), mixed(along_x(layer), along_x(layer + row), v),
                 w);
}

double Voxels::open_share(Vec3 from, Vec3 d, double slope, double reach_m, double lift_m) const {
    double open = 1;
    int level = 0;
    for (double t = lift_m; t < reach_m && open > 0.02;) {
        const double wide = std::max(cell_m_, 2 * slope * t);
        while (level + 1 < level_count && wide > 1.4 * cell_m_ * (1 << level))
            ++level;
        // A wall as thin as the finest cells hides all behind it, although it fills a small share
        // of a large cell.
        const double filled = filled_at(from + d * t, level) * (1 << level);
        // Steps are a little shorter than the cells.
        open *= 1 - 0.8 * std::min(1.0, filled);
        t += 0.75 * wide;
    }
    return open;
}

}  // namespace theatron::furniture
