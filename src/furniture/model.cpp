// SPDX-License-Identifier: Apache-2.0
#include "furniture/model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace theatron::furniture {
namespace {

using render::MeshData;

// The longest side of a box's triangles, about.
constexpr double cell_m = 0.5;
constexpr double least_bevel_m = 0.0065;

MeshData::Vertex corner(Vec3 p, Vec3 n) {
    return {float(p.x), float(p.y), float(p.z), float(n.x), float(n.y), float(n.z)};
}

Vec3 place_of(const MeshData::Vertex& v) {
    return {v.px, v.py, v.pz};
}

// Appends a triangle so that it is counter-clockwise seen from `outside`.
void add_triangle(MeshData& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, Vec3 outside) {
    const Vec3 pa = place_of(mesh.vertices[a]), pb = place_of(mesh.vertices[b]),
               pc = place_of(mesh.vertices[c]);
    if (dot(cross(pb - pa, pc - pa), outside) < 0)
        std::swap(b, c);
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

double& axis_of(Vec3& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
double axis_of(const Vec3& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// Six flat sides, whose corners keep the sides' normals; the strips and triangles between them look
// rounded, because they interpolate these normals.
class BoxMaker {
public:
    BoxMaker(MeshData& mesh, Vec3 low, Vec3 high, double bevel)
        : mesh_(mesh), low_(low), high_(high) {
        const Vec3 size = high - low;
        // Finer edges would be seen by nobody.
        bevel_ =
            bevel < least_bevel_m ? 0 : std::min(bevel, 0.45 * std::min({size.x, size.y, size.z}));
        for (int a = 0; a < 3; ++a)
            cells_[std::size_t(a)] = std::max(1, int(std::lround(axis_of(size, a) / cell_m)));
        for (int a = 0; a < 3; ++a)
            for (int s = 0; s < 2; ++s)
                add_side(a, s);
        for (int t = 0; t < 3; ++t)
            for (int s = 0; s < 4; ++s)
                add_edge(t, s & 1, s >> 1);
        for (int s = 0; s < 8; ++s)
            add_corner(s & 1, (s >> 1) & 1, s >> 2);
    }

private:
    int cells(int axis) const { return cells_[std::size_t(axis)]; }
    static Vec3 direction(int axis, int side) {
        Vec3 n;
        axis_of(n, axis) = side ? 1 : -1;
        return n;
    }
    void add_side(int a, int s) {
        const int u = (a + 1) % 3, v = (a + 2) % 3;
        first_[std::size_t(a)][std::size_t(s)] = std::uint32_t(mesh_.vertices.size());
        const Vec3 n = direction(a, s);
        for (int j = 0; j <= cells(v); ++j)
            for (int i = 0; i <= cells(u); ++i) {
                Vec3 p;
                axis_of(p, a) = axis_of(s ? high_ : low_, a);
                axis_of(p, u) = along(u, i);
                axis_of(p, v) = along(v, j);
                mesh_.vertices.push_back(corner(p, n));
            }
        for (int j = 0; j < cells(v); ++j)
            for (int i = 0; i < cells(u); ++i) {
                const auto at = [&](int di, int dj) { return side_corner(a, s, i + di, j + dj); };
                add_triangle(mesh_, at(0, 0), at(1, 0), at(1, 1), n);
                add_triangle(mesh_, at(0, 0), at(1, 1), at(0, 1), n);
            }
    }
    double along(int axis, int i) const {
        const double l = axis_of(low_, axis) + bevel_, h = axis_of(high_, axis) - bevel_;
        return l + (h - l) * i / cells(axis);
    }
    std::uint32_t side_corner(int a, int s, int i, int j) const {
        return first_[std::size_t(a)][std::size_t(s)] +
               std::uint32_t(j * (cells((a + 1) % 3) + 1) + i);
    }
    // The corner of side (a, s) at the end `e` of axis `c` and at place `k` along the third axis.
    std::uint32_t border(int a, int s, int c, int e, int k) const {
        const int last = e ? cells(c) : 0;
        return c == (a + 1) % 3 ? side_corner(a, s, last, k) : side_corner(a, s, k, last);
    }
    void add_edge(int t, int sa, int sc) {
        if (bevel_ <= 0)
            return;
        const int a = (t + 1) % 3, c = (t + 2) % 3;
        const Vec3 out = direction(a, sa) + direction(c, sc);
        for (int k = 0; k < cells(t); ++k) {
            const std::uint32_t a0 = border(a, sa, c, sc, k), a1 = border(a, sa, c, sc, k + 1),
                                c0 = border(c, sc, a, sa, k), c1 = border(c, sc, a, sa, k + 1);
            add_triangle(mesh_, a0, a1, c1, out);
            add_triangle(mesh_, a0, c1, c0, out);
        }
    }
    void add_corner(int sx, int sy, int sz) {
        if (bevel_ <= 0)
            return;
        const auto end = [&](int axis, int s) { return s ? cells(axis) : 0; };
        add_triangle(mesh_, border(0, sx, 1, sy, end(2, sz)), border(1, sy, 2, sz, end(0, sx)),
                     border(2, sz, 0, sx, end(1, sy)),
                     direction(0, sx) + direction(1, sy) + direction(2, sz));
    }

    MeshData& mesh_;
    Vec3 low_, high_;
    double bevel_ = 0;
    std::array<int, 3> cells_{};
    std::uint32_t first_[3][2] = {};
};

// A ring of `sides` + 0 corners: the last one is the first one again.
void add_ring(MeshData& mesh, Vec3 middle, Vec3 x, Vec3 y, double radius, Vec3 along,
              double outward, int sides) {
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        const Vec3 out = x * std::cos(angle) + y * std::sin(angle);
        mesh.vertices.push_back(corner(middle + out * radius, normalized(out * outward + along)));
    }
}

void join_rings(MeshData& mesh, std::uint32_t below, std::uint32_t above, int sides,
                bool below_is_point, bool above_is_point) {
    for (int i = 0; i < sides; ++i) {
        const auto k = std::uint32_t(i), next = std::uint32_t((i + 1) % sides);
        if (!below_is_point)
            mesh.indices.insert(mesh.indices.end(), {below + k, below + next, above + k});
        if (!above_is_point)
            mesh.indices.insert(mesh.indices.end(), {below + next, above + next, above + k});
    }
}

// About the y axis: x to the right, and -z, so that the rings run counter-clockwise from above.
MeshData round_mesh(const std::vector<Vec2>& profile, int sides) {
    MeshData mesh;
    const auto normal = [&](std::size_t segment) {
        const Vec2 a = profile[segment], b = profile[segment + 1];
        const double l = std::hypot(b.x - a.x, b.y - a.y);
        return Vec2{(b.y - a.y) / l, (a.x - b.x) / l};
    };
    const std::size_t segments = profile.size() - 1;
    for (std::size_t s = 0; s < segments; ++s) {
        const Vec2 n = normal(s);
        const auto at_end = [&](std::size_t other, bool exists) {
            if (!exists)
                return n;
            const Vec2 m = normal(other);
            // Sharper edges stay edges.
            return m.x * n.x + m.y * n.y > 0.7 ? Vec2{m.x + n.x, m.y + n.y} : n;
        };
        const Vec2 n0 = at_end(s - 1, s > 0), n1 = at_end(s + 1, s + 1 < segments);
        const Vec2 a = profile[s], b = profile[s + 1];
        const auto below = std::uint32_t(mesh.vertices.size());
        add_ring(mesh, {0, a.y, 0}, {1, 0, 0}, {0, 0, -1}, a.x, {0, n0.y, 0}, n0.x, sides);
        const auto above = std::uint32_t(mesh.vertices.size());
        add_ring(mesh, {0, b.y, 0}, {1, 0, 0}, {0, 0, -1}, b.x, {0, n1.y, 0}, n1.x, sides);
        join_rings(mesh, below, above, sides, a.x == 0, b.x == 0);
    }
    return mesh;
}

MeshData rod_mesh(const std::vector<Vec3>& points, double radius, int sides) {
    MeshData mesh;
    const std::size_t last = points.size() - 1;
    const auto direction = [&](std::size_t i) { return normalized(points[i + 1] - points[i]); };
    // The directions across a segment that point outside; turned as little as possible at bends.
    std::vector<Vec3> across;
    {
        const Vec3 d = direction(0);
        const Vec3 x = normalized(cross(std::abs(d.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, d));
        for (int i = 0; i < sides; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            across.push_back(x * std::cos(angle) + cross(d, x) * std::sin(angle));
        }
    }
    const auto add = [&](const std::vector<Vec3>& places, const std::vector<Vec3>& normals) {
        const auto first = std::uint32_t(mesh.vertices.size());
        for (std::size_t i = 0; i < places.size(); ++i)
            mesh.vertices.push_back(corner(places[i], normals[i]));
        return first;
    };
    const auto cap = [&](const std::vector<Vec3>& places, Vec3 middle, Vec3 normal, bool first) {
        const std::uint32_t ring = add(places, std::vector<Vec3>(places.size(), normal));
        const auto tip = std::uint32_t(mesh.vertices.size());
        mesh.vertices.push_back(corner(middle, normal));
        for (int i = 0; i < sides; ++i) {
            const std::uint32_t k = ring + std::uint32_t(i),
                                next = ring + std::uint32_t((i + 1) % sides);
            if (first)
                mesh.indices.insert(mesh.indices.end(), {tip, next, k});
            else
                mesh.indices.insert(mesh.indices.end(), {tip, k, next});
        }
    };
    std::uint32_t below = 0;
    for (std::size_t i = 0; i <= last; ++i) {
        const Vec3 before = direction(i > 0 ? i - 1 : 0),
                   after = direction(i < last ? i : last - 1);
        // The ring lies in the plane between the two segments.
        const Vec3 plane = normalized(before + after);
        std::vector<Vec3> places, next = across, between = across;
        for (std::size_t k = 0; k < across.size(); ++k) {
            const Vec3 off = across[k] * radius;
            places.push_back(points[i] + off - before * (dot(off, plane) / dot(before, plane)));
            next[k] =
                across[k] - (before + after) * (dot(across[k], after) / (1 + dot(before, after)));
            between[k] = normalized(across[k] + next[k]);
        }
        if (i == 0)
            cap(places, points[0], before * -1, true);
        // Sharper bends stay edges.
        const bool smooth = dot(before, after) > 0.8;
        if (i > 0)
            join_rings(mesh, below, add(places, smooth ? between : across), sides, false, false);
        if (i < last)
            below = add(places, smooth ? between : next);
        else
            cap(places, points[last], after, false);
        across = next;
    }
    return mesh;
}

}  // namespace

void append_at(MeshData& mesh, const MeshData& part, const Pose& place) {
    const auto first = std::uint32_t(mesh.vertices.size());
    for (const MeshData::Vertex& v : part.vertices)
        mesh.vertices.push_back(
            corner(place * place_of(v), rotate(place.rotation, Vec3{v.nx, v.ny, v.nz})));
    for (const std::uint32_t i : part.indices)
        mesh.indices.push_back(first + i);
}

MeshData& Model::of(Material material) {
    for (Part& part : parts)
        if (part.material == material)
            return part.mesh;
    parts.push_back({material, {}});
    return parts.back().mesh;
}

void Model::box(Material material, Vec3 low, Vec3 high, double bevel) {
    BoxMaker(of(material), low, high, bevel);
}

void Model::turned_box(Material material, const Pose& pose, Vec3 size, double bevel) {
    MeshData mesh;
    BoxMaker(mesh, size * -0.5, size * 0.5, bevel);
    append_at(of(material), mesh, pose);
}

void Model::rod(Material material, const std::vector<Vec3>& points, double radius, int sides) {
    append_at(of(material), rod_mesh(points, radius, sides), {});
}

void Model::round(Material material, Vec3 place, const std::vector<Vec2>& profile, int sides) {
    append_at(of(material), round_mesh(profile, sides), {Quat{}, place});
}

void Model::turned_round(Material material, const Pose& pose, const std::vector<Vec2>& profile,
                         int sides) {
    append_at(of(material), round_mesh(profile, sides), pose);
}

void Model::cylinder(Material material, Vec3 bottom, double radius, double height, double bevel,
                     int sides) {
    if (bevel < least_bevel_m)
        return round(material, bottom, {{0, 0}, {radius, 0}, {radius, height}, {0, height}}, sides);
    round(material, bottom,
          {{0, 0},
           {radius - bevel, 0},
           {radius, bevel},
           {radius, height - bevel},
           {radius - bevel, height},
           {0, height}},
          sides);
}

void Model::add(const Model& other, const Pose& place) {
    for (const Part& part : other.parts)
        append_at(of(part.material), part.mesh, place);
}

Box bounds(const Model& model) {
    Box box{{1e30, 1e30, 1e30}, {-1e30, -1e30, -1e30}};
    for (const Model::Part& part : model.parts)
        for (const MeshData::Vertex& v : part.mesh.vertices) {
            box.low = {std::min<double>(box.low.x, v.px), std::min<double>(box.low.y, v.py),
                       std::min<double>(box.low.z, v.pz)};
            box.high = {std::max<double>(box.high.x, v.px), std::max<double>(box.high.y, v.py),
                        std::max<double>(box.high.z, v.pz)};
        }
    return box;
}

}  // namespace theatron::furniture
