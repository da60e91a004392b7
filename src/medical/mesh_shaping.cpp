// SPDX-License-Identifier: Apache-2.0
#include "medical/mesh_shaping.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "medical/mesh_measures.h"

namespace theatron::medical {
namespace {

constexpr std::uint32_t none = 0xffffffff;

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
}

// Each edge once for each triangle at it, sorted.
std::vector<std::uint64_t> edges_of(const Mesh& mesh) {
    std::vector<std::uint64_t> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const Triangle& t : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i)
            edges.push_back(edge_key(t[i], t[(i + 1) % 3]));
    std::sort(edges.begin(), edges.end());
    return edges;
}

// The neighbours of every vertex in one list.
struct Neighbours {
    explicit Neighbours(const Mesh& mesh) : begin(mesh.positions.size() + 1), open(begin.size()) {
        std::vector<std::uint64_t> edges = edges_of(mesh);
        std::vector<std::uint64_t> single;
        for (std::size_t i = 0; i < edges.size();) {
            std::size_t end = i;
            while (end < edges.size() && edges[end] == edges[i])
                ++end;
            const std::size_t a = edges[i] >> 32, b = edges[i] & 0xffffffff;
            if (end - i != 2)
                open[a] = open[b] = true;
            single.push_back(edges[i]);
            ++begin[a + 1];
            ++begin[b + 1];
            i = end;
        }
        for (std::size_t i = 1; i < begin.size(); ++i)
            begin[i] += begin[i - 1];
        list.resize(begin.back());
        std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
        for (const std::uint64_t edge : single) {
            const auto a = std::uint32_t(edge >> 32), b = std::uint32_t(edge & 0xffffffff);
            list[next[a]++] = b;
            list[next[b]++] = a;
        }
    }

    std::vector<std::uint32_t> begin;  // of each vertex, in `list`
    std::vector<std::uint32_t> list;
    std::vector<bool> open;  // at an edge that has not two triangles
};

void relax(std::vector<Vec3>& positions, std::vector<Vec3>& moved, const Neighbours& neighbours,
           double share) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const std::uint32_t first = neighbours.begin[i], end = neighbours.begin[i + 1];
        moved[i] = positions[i];
        if (neighbours.open[i] || first == end)
            continue;
        Vec3 sum;
        for (std::uint32_t k = first; k < end; ++k)
            sum = sum + positions[neighbours.list[k]];
        moved[i] = positions[i] + (sum * (1.0 / (end - first)) - positions[i]) * share;
    }
    positions.swap(moved);
}

void drop_unused_vertices(Mesh& mesh) {
    std::vector<std::uint32_t> number(mesh.positions.size(), none);
    std::uint32_t count = 0;
    for (Triangle& t : mesh.triangles)
        for (std::uint32_t& v : t) {
            if (number[v] == none)
                number[v] = count++;
            v = number[v];
        }
    std::vector<Vec3f> kept(count);
    for (std::size_t i = 0; i < number.size(); ++i)
        if (number[i] != none)
            kept[number[i]] = mesh.positions[i];
    mesh.positions = std::move(kept);
    mesh.normals.clear();
}

}  // namespace

void weld(Mesh& mesh) {
    std::vector<std::uint32_t> order(mesh.positions.size()), first(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = std::uint32_t(i);
    const auto less = [&](std::uint32_t a, std::uint32_t b) {
        const Vec3f p = mesh.positions[a], q = mesh.positions[b];
        if (p.x != q.x)
            return p.x < q.x;
        if (p.y != q.y)
            return p.y < q.y;
        return p.z != q.z ? p.z < q.z : a < b;
    };
    std::sort(order.begin(), order.end(), less);
    for (std::size_t i = 0; i < order.size(); ++i)
        first[order[i]] = i > 0 && mesh.positions[order[i]] == mesh.positions[order[i - 1]]
                              ? first[order[i - 1]]
                              : order[i];
    for (Triangle& t : mesh.triangles)
        for (std::uint32_t& v : t)
            v = first[v];
    std::erase_if(mesh.triangles,
                  [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    drop_unused_vertices(mesh);
}

void smooth(Mesh& mesh, int rounds) {
    constexpr double lambda = 0.5, mu = -0.53;
    const Neighbours neighbours(mesh);
    std::vector<Vec3> positions, moved(mesh.positions.size());
    for (const Vec3f p : mesh.positions)
        positions.push_back(to_double(p));
    for (int i = 0; i < rounds; ++i) {
        relax(positions, moved, neighbours, lambda);
        relax(positions, moved, neighbours, mu);
    }
    for (std::size_t i = 0; i < positions.size(); ++i)
        mesh.positions[i] = to_float(positions[i]);
}

void restore_volume(Mesh& mesh, double volume_mm3) {
    for (int round = 0; round < 8; ++round) {
        const MeshShape shape = shape_of(mesh);
        const double missing = volume_mm3 - shape.volume_mm3;
        if (!(shape.area_mm2 > 0) || std::abs(missing) < 1e-4 * std::abs(volume_mm3))
            return;
        // Thin surfaces turn inside out when they are moved far at once.
        const double far = std::clamp(missing / shape.area_mm2, -0.3, 0.3);
        compute_normals(mesh);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            mesh.positions[i] =
                to_float(to_double(mesh.positions[i]) + to_double(mesh.normals[i]) * far);
    }
}

}  // namespace theatron::medical
