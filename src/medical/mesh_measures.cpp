// SPDX-License-Identifier: Apache-2.0
#include "medical/mesh_measures.h"

#include <algorithm>
#include <cstdlib>

namespace theatron::medical {
namespace {

// An edge with the direction in which a triangle runs along it.
struct Edge {
    std::uint64_t key = 0;  // the smaller vertex first
    bool forward = false;   // from the smaller to the larger
    bool operator<(const Edge& other) const {
        return key != other.key ? key < other.key : forward < other.forward;
    }
};

std::vector<Edge> sorted_edges(const Mesh& mesh) {
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const Triangle& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) {
            const std::uint64_t a = t[std::size_t(i)], b = t[std::size_t((i + 1) % 3)];
            edges.push_back({std::min(a, b) << 32 | std::max(a, b), a < b});
        }
    std::sort(edges.begin(), edges.end());
    return edges;
}

// Corners of triangles in groups that an edge at their common vertex connects.
class Fans {
public:
    explicit Fans(std::size_t corners) : parent_(corners) {
        for (std::size_t i = 0; i < corners; ++i)
            parent_[i] = std::uint32_t(i);
    }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

private:
    std::vector<std::uint32_t> parent_;
};

// True if the triangles at each vertex form one fan. Each edge of `mesh` must have two triangles.
bool has_one_fan_per_vertex(const Mesh& mesh) {
    struct Half {
        std::uint64_t key;
        std::uint32_t low_corner, high_corner;  // at the smaller and the larger vertex
    };
    std::vector<Half> halves;
    halves.reserve(3 * mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint64_t a = mesh.triangles[i][k], b = mesh.triangles[i][(k + 1) % 3];
            const auto from = std::uint32_t(3 * i + k), to = std::uint32_t(3 * i + (k + 1) % 3);
            halves.push_back(
                {std::min(a, b) << 32 | std::max(a, b), a < b ? from : to, a < b ? to : from});
        }
    std::sort(halves.begin(), halves.end(),
              [](const Half& a, const Half& b) { return a.key < b.key; });
    Fans fans(3 * mesh.triangles.size());
    for (std::size_t i = 0; i + 1 < halves.size(); i += 2) {
        fans.join(halves[i].low_corner, halves[i + 1].low_corner);
        fans.join(halves[i].high_corner, halves[i + 1].high_corner);
    }
    constexpr std::uint32_t no_corner = 0xffffffff;
    std::vector<std::uint32_t> fan_of(mesh.positions.size(), no_corner);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (std::uint32_t k = 0; k < 3; ++k) {
            std::uint32_t& fan = fan_of[mesh.triangles[i][k]];
            const std::uint32_t here = fans.find(std::uint32_t(3 * i + k));
            if (fan == no_corner)
                fan = here;
            if (fan != here)
                return false;
        }
    return true;
}

}  // namespace

MeshShape shape_of(const Mesh& mesh) {
    MeshShape shape;
    if (mesh.triangles.empty())
        return shape;
    shape.closed = shape.manifold = true;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = to_double(mesh.positions[t[0]]), b = to_double(mesh.positions[t[1]]),
                   c = to_double(mesh.positions[t[2]]);
        shape.volume_mm3 += dot(a, cross(b, c)) / 6;
        shape.area_mm2 += length(cross(b - a, c - a)) / 2;
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
            shape.closed = false;
    }
    const std::vector<Edge> edges = sorted_edges(mesh);
    for (std::size_t i = 0; i < edges.size() && shape.closed;) {
        std::size_t end = i;
        std::ptrdiff_t balance = 0;
        for (; end < edges.size() && edges[end].key == edges[i].key; ++end)
            balance += edges[end].forward ? 1 : -1;
        shape.closed = balance == 0;
        shape.manifold = shape.manifold && end - i == 2;
        i = end;
    }
    shape.manifold = shape.manifold && shape.closed && has_one_fan_per_vertex(mesh);
    return shape;
}

Box box_of(const Mesh& mesh) {
    if (mesh.positions.empty())
        return {};
    Box box{to_double(mesh.positions[0]), to_double(mesh.positions[0])};
    for (const Vec3f p : mesh.positions) {
        box.low_mm = {std::min(box.low_mm.x, double(p.x)), std::min(box.low_mm.y, double(p.y)),
                      std::min(box.low_mm.z, double(p.z))};
        box.high_mm = {std::max(box.high_mm.x, double(p.x)), std::max(box.high_mm.y, double(p.y)),
                       std::max(box.high_mm.z, double(p.z))};
    }
    return box;
}

bool overlap(const Box& a, const Box& b) {
    return a.low_mm.x <= b.high_mm.x && b.low_mm.x <= a.high_mm.x && a.low_mm.y <= b.high_mm.y &&
           b.low_mm.y <= a.high_mm.y && a.low_mm.z <= b.high_mm.z && b.low_mm.z <= a.high_mm.z;
}

}  // namespace theatron::medical
