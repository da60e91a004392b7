// SPDX-License-Identifier: Apache-2.0
#include "synthetic/implicit.h"

namespace theatron::synthetic {
namespace {

F3 slope(const Distance& f, F3 p, float h) {
    return F3{f({p.x + h, p.y, p.z}) - f({p.x - h, p.y, p.z}),
              f({p.x, p.y + h, p.z}) - f({p.x, p.y - h, p.z}),
              f({p.x, p.y, p.z + h}) - f({p.x, p.y, p.z - h})} *
           (1 / (2 * h));
}

}  // namespace

float openness_of(const Distance& distance, F3 position, F3 normal, float reach) {
    float hidden = 0, weight = 0.5f;
    for (int i = 1; i <= 4; ++i) {
        const float step = reach * float(i) / 4;
        hidden += weight * std::max(0.0f, step - distance(position + normal * step)) / step;
        weight *= 0.7f;
    }
    return std::clamp(1 - hidden * 0.7f, 0.25f, 1.0f);
}

Mesh make_surface(const Distance& distance, F3 low, F3 high, float cell, Look look) {
    const int nx = int((high.x - low.x) / cell) + 2, ny = int((high.y - low.y) / cell) + 2,
              nz = int((high.z - low.z) / cell) + 2;
    const auto point = [&](int x, int y, int z) {
        return low + F3{float(x), float(y), float(z)} * cell;
    };
    const auto layer = std::size_t(nx) * std::size_t(ny);
    const auto at = [&](int x, int y) { return std::size_t(y) * std::size_t(nx) + std::size_t(x); };
    constexpr auto none = ~std::uint32_t(0);

    Mesh mesh;
    std::vector<float> below(layer), above(layer);
    std::vector<std::uint32_t> cells_below(layer, none), cells_here(layer, none);
    // Far from the surface neighbouring samples are skipped: the distance changes by at most
    // about one per unit length.
    const auto sample_layer = [&](int z, std::vector<float>& out) {
        for (int y = 0; y < ny; ++y)
            for (int x = 0; x < nx;) {
                const float d = distance(point(x, y, z));
                out[at(x, y)] = d;
                const int skip = std::min(int((std::abs(d) / cell - 2) * 0.6f), nx - 1 - x);
                for (int i = 1; i <= skip; ++i)
                    out[at(x + i, y)] = d;
                x += std::max(skip, 0) + 1;
            }
    };
    sample_layer(0, below);
    for (int z = 0; z + 1 < nz; ++z) {
        sample_layer(z + 1, above);
        std::fill(cells_here.begin(), cells_here.end(), none);
        const auto value = [&](int x, int y, int dz) { return (dz ? above : below)[at(x, y)]; };
        for (int y = 0; y + 1 < ny; ++y)
            for (int x = 0; x + 1 < nx; ++x) {
                // The mean of the crossings on the cell's edges becomes its vertex.
                F3 sum{};
                int crossings = 0;
                for (int e = 0; e < 12; ++e) {
                    static constexpr int ends[12][6] = {
                        {0, 0, 0, 1, 0, 0}, {0, 1, 0, 1, 1, 0}, {0, 0, 1, 1, 0, 1},
                        {0, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 1, 0}, {1, 0, 0, 1, 1, 0},
                        {0, 0, 1, 0, 1, 1}, {1, 0, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 1},
                        {1, 0, 0, 1, 0, 1}, {0, 1, 0, 0, 1, 1}, {1, 1, 0, 1, 1, 1}};
                    const auto& q = ends[e];
                    const float a = value(x + q[0], y + q[1], q[2]),
                                b = value(x + q[3], y + q[4], q[5]);
                    if ((a < 0) == (b < 0))
                        continue;
                    const float t = a / (a - b);
                    sum += mix(point(x + q[0], y + q[1], z + q[2]),
                               point(x + q[3], y + q[4], z + q[5]), t);
                    ++crossings;
                }
                if (crossings == 0)
                    continue;
                F3 p = sum * (1 / float(crossings));
                F3 n = slope(distance, p, cell * 0.5f);
                p = p - n * (distance(p) / std::max(dot(n, n), 0.25f));
                n = normalized(slope(distance, p, cell * 0.35f));
                cells_here[at(x, y)] = mesh.add_vertex(p, n, p);
                mesh.openness.back() = openness_of(distance, p, n, 0.08f);
            }
        // A quad around each grid edge that crosses the surface.
        const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                              bool flip) {
            if (a == none || b == none || c == none || d == none)
                return;
            flip ? mesh.add_quad(a, d, c, b, look) : mesh.add_quad(a, b, c, d, look);
        };
        for (int y = 0; y + 1 < ny; ++y)
            for (int x = 0; x + 1 < nx; ++x) {
                const bool inside = value(x, y, 0) < 0;
                if (x > 0 && y > 0 && inside != (value(x, y, 1) < 0))
                    quad(cells_here[at(x - 1, y - 1)], cells_here[at(x, y - 1)],
                         cells_here[at(x, y)], cells_here[at(x - 1, y)], !inside);
                if (z > 0 && y > 0 && inside != (value(x + 1, y, 0) < 0))
                    quad(cells_below[at(x, y - 1)], cells_below[at(x, y)], cells_here[at(x, y)],
                         cells_here[at(x, y - 1)], !inside);
                if (z > 0 && x > 0 && inside != (value(x, y + 1, 0) < 0))
                    quad(cells_below[at(x - 1, y)], cells_here[at(x - 1, y)], cells_here[at(x, y)],
                         cells_below[at(x, y)], !inside);
            }
        std::swap(below, above);
        std::swap(cells_below, cells_here);
    }
    return mesh;
}

}  // namespace theatron::synthetic
