// SPDX-License-Identifier: Apache-2.0
#include "synthetic/mesh.h"

#include <map>

namespace theatron::synthetic {

void Mesh::append(const Mesh& other) {
    append(other, Affine{});
}

void Mesh::append(const Mesh& other, const Affine& placed) {
    const auto first = std::uint32_t(positions.size());
    // Normals transform by the inverse transpose; cofactors give it up to a factor.
    const F3 nx = cross(placed.y, placed.z), ny = cross(placed.z, placed.x),
             nz = cross(placed.x, placed.y);
    const bool mirrored = dot(placed.x, nx) < 0;
    for (std::size_t i = 0; i < other.positions.size(); ++i) {
        const F3 n = other.normals[i];
        F3 turned = normalized(nx * n.x + ny * n.y + nz * n.z);
        positions.push_back(placed * other.positions[i]);
        normals.push_back(mirrored ? -turned : turned);
        textures.push_back(other.textures[i]);
        openness.push_back(other.openness[i]);
    }
    for (Triangle t : other.triangles) {
        if (mirrored)
            std::swap(t.b, t.c);
        triangles.push_back({t.a + first, t.b + first, t.c + first, t.look});
    }
}

void smooth_normals(Mesh& mesh) {
    std::fill(mesh.normals.begin(), mesh.normals.end(), F3{});
    for (const Triangle& t : mesh.triangles) {
        const F3 a = mesh.positions[t.a];
        const F3 n = cross(mesh.positions[t.b] - a, mesh.positions[t.c] - a);
        for (const auto v : {t.a, t.b, t.c})
            mesh.normals[v] += n;
    }
    for (F3& n : mesh.normals)
        n = normalized(n);
}

void split_long_edges(Mesh& mesh, float longest) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, added] = middles.try_emplace(std::minmax(a, b), 0u);
        if (added) {
            at->second = mesh.add_vertex((mesh.positions[a] + mesh.positions[b]) * 0.5f,
                                         normalized(mesh.normals[a] + mesh.normals[b]),
                                         (mesh.textures[a] + mesh.textures[b]) * 0.5f);
            mesh.openness[at->second] = (mesh.openness[a] + mesh.openness[b]) * 0.5f;
        }
        return at->second;
    };
    for (std::size_t i = 0; i < mesh.triangles.size();) {
        const Triangle t = mesh.triangles[i];
        const std::uint32_t v[3] = {t.a, t.b, t.c};
        int worst = 0;
        float worst_length = 0;
        for (int e = 0; e < 3; ++e) {
            const float l = length(mesh.positions[v[e]] - mesh.positions[v[(e + 1) % 3]]);
            if (l > worst_length) {
                worst_length = l;
                worst = e;
            }
        }
        if (worst_length <= longest) {
            ++i;
            continue;
        }
        // The neighbour splits this edge at the same point, because it is too long there too.
        const auto a = v[worst], b = v[(worst + 1) % 3], c = v[(worst + 2) % 3];
        const auto m = middle(a, b);
        mesh.triangles[i] = {a, m, c, t.look};
        mesh.triangles.push_back({m, b, c, t.look});
    }
}

Mesh make_sheet(int nu, int nv, const std::function<F3(float u, float v)>& position, Look look) {
    Mesh mesh;
    for (int j = 0; j <= nv; ++j)
        for (int i = 0; i <= nu; ++i) {
            const F3 p = position(float(i) / float(nu), float(j) / float(nv));
            mesh.add_vertex(p, {}, p);
        }
    const auto at = [&](int i, int j) { return std::uint32_t(j * (nu + 1) + i); };
    for (int j = 0; j < nv; ++j)
        for (int i = 0; i < nu; ++i)
            mesh.add_quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), look);
    smooth_normals(mesh);
    return mesh;
}

Mesh make_box(F3 size, float bevel, Look look) {
    // Each face is a grid; its outer cells form the rounded edges.
    Mesh mesh;
    const F3 half = size * 0.5f;
    const float r = std::min({bevel, half.x, half.y, half.z});
    const F3 inner = half - F3{r, r, r};
    constexpr int rounding = 3;
    const Affine faces[6] = {
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}},  {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {}},
        {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}, {}}, {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}, {}},
        {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}}, {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {}}};
    // Positions along a side: half of the quarter circle, the flat part, the other half.
    float angles[2 * rounding + 2];
    int count = 0;
    const int steps = r > 0 ? rounding : 0;
    for (int i = 0; i <= steps; ++i)
        angles[count++] = -pi / 4 * (1 - float(i) / float(std::max(steps, 1)));
    if (steps == 0)
        angles[0] = 0;
    const int side = count;
    for (int i = 0; i < side; ++i)
        angles[count++] = -angles[side - 1 - i];
    for (const Affine& face : faces) {
        const auto first = std::uint32_t(mesh.positions.size());
        for (int j = 0; j < count; ++j)
            for (int i = 0; i < count; ++i) {
                const F3 direction =
                    normalized(face.turn({std::tan(angles[i]), std::tan(angles[j]), 1}));
                const F3 corner = face.turn({i < side ? -1.0f : 1.0f, j < side ? -1.0f : 1.0f, 1});
                const F3 p = corner * inner + direction * r;
                const F3 n = steps == 0 ? face.z : direction;
                const F3 sharp = corner * half;
                const F3 at = steps == 0 ? sharp : p;
                mesh.add_vertex(at, n, at);
            }
        for (int j = 0; j + 1 < count; ++j)
            for (int i = 0; i + 1 < count; ++i) {
                const auto v = first + std::uint32_t(j * count + i);
                const auto up = v + std::uint32_t(count);
                mesh.add_quad(v, v + 1, up + 1, up, look);
            }
    }
    return mesh;
}

Mesh make_tube(const std::vector<F3>& path, const std::vector<float>& radii, int sides, Look look,
               float squash, F3 up) {
    Mesh mesh;
    const int n = int(path.size());
    const auto radius = [&](int i) { return radii.size() == 1 ? radii[0] : radii[std::size_t(i)]; };
    float along = 0;
    const auto ring = [&](F3 centre, F3 x, F3 y, float r) {
        for (int s = 0; s < sides; ++s) {
            const float a = 2 * pi * float(s) / float(sides);
            const F3 out = x * std::cos(a) + y * (std::sin(a) * squash);
            mesh.add_vertex(centre + out * r, {},
                            {std::cos(a) * r, along, std::sin(a) * r * squash});
        }
    };
    F3 x{};
    for (int i = 0; i < n; ++i) {
        const F3 before = path[std::size_t(std::max(i - 1, 0))];
        const F3 after = path[std::size_t(std::min(i + 1, n - 1))];
        const F3 tangent = normalized(after - before);
        if (i == 0) {
            x = cross(up, tangent);
            x = dot(x, x) > 1e-8f ? normalized(x) : any_perpendicular(tangent);
        } else {
            x = normalized(x - tangent * dot(x, tangent));  // transported without twist
            along += length(path[std::size_t(i)] - path[std::size_t(i - 1)]);
        }
        const F3 y = cross(tangent, x);
        const F3 at = path[std::size_t(i)];
        const float r = radius(i);
        if (i == 0) {
            ring(at - tangent * (r * 0.85f), x, y, r * 0.3f);
            ring(at - tangent * (r * 0.5f), x, y, r * 0.8f);
        }
        ring(at, x, y, r);
        if (i == n - 1) {
            ring(at + tangent * (r * 0.5f), x, y, r * 0.8f);
            ring(at + tangent * (r * 0.85f), x, y, r * 0.3f);
        }
    }
    const int rings = n + 4;
    const auto at = [&](int i, int s) { return std::uint32_t(i * sides + s % sides); };
    for (int i = 0; i + 1 < rings; ++i)
        for (int s = 0; s < sides; ++s)
            mesh.add_quad(at(i, s), at(i, s + 1), at(i + 1, s + 1), at(i + 1, s), look);
    for (int s = 1; s + 1 < sides; ++s) {
        mesh.add_triangle(at(0, 0), at(0, s + 1), at(0, s), look);
        mesh.add_triangle(at(rings - 1, 0), at(rings - 1, s), at(rings - 1, s + 1), look);
    }
    smooth_normals(mesh);
    return mesh;
}

Mesh make_lathe(const std::vector<std::pair<float, float>>& profile, int sides, Look look) {
    Mesh mesh;
    for (const auto& [r, y] : profile)
        for (int s = 0; s < sides; ++s) {
            const float a = 2 * pi * float(s) / float(sides);
            const F3 p{std::cos(a) * r, y, -std::sin(a) * r};
            mesh.add_vertex(p, {}, p);
        }
    const auto at = [&](std::size_t i, int s) {
        return std::uint32_t(i * std::size_t(sides) + std::size_t(s % sides));
    };
    for (std::size_t i = 0; i + 1 < profile.size(); ++i)
        for (int s = 0; s < sides; ++s)
            mesh.add_quad(at(i, s), at(i, s + 1), at(i + 1, s + 1), at(i + 1, s), look);
    smooth_normals(mesh);
    return mesh;
}

Mesh make_picture(float width, float height, int number, Look look) {
    Mesh mesh;
    const float w = width / 2, h = height / 2, n = float(number);
    const auto a = mesh.add_vertex({-w, -h, 0}, {0, 0, 1}, {0, 1, n});
    const auto b = mesh.add_vertex({w, -h, 0}, {0, 0, 1}, {1, 1, n});
    const auto c = mesh.add_vertex({w, h, 0}, {0, 0, 1}, {1, 0, n});
    const auto d = mesh.add_vertex({-w, h, 0}, {0, 0, 1}, {0, 0, n});
    mesh.add_quad(a, b, c, d, look);
    return mesh;
}

Mesh make_cylinder(float radius, float height, int sides, Look look) {
    const float e = std::min(radius, height) * 0.06f;
    return make_lathe({{0.0f, 0.0f},
                       {radius - e, 0.0f},
                       {radius, e},
                       {radius, e * 1.5f},
                       {radius, height - e * 1.5f},
                       {radius, height - e},
                       {radius - e, height},
                       {radius - 2 * e, height},
                       {0.0f, height}},
                      sides, look);
}

Mesh make_ball(F3 radii, int sides, Look look) {
    std::vector<std::pair<float, float>> profile;
    const int rings = std::max(sides / 2, 4);
    for (int i = 0; i <= rings; ++i) {
        const float a = pi * (float(i) / float(rings) - 0.5f);
        profile.emplace_back(std::cos(a), std::sin(a));
    }
    Mesh mesh;
    mesh.append(make_lathe(profile, sides, look), scaling(radii));
    mesh.textures = mesh.positions;
    return mesh;
}

}  // namespace theatron::synthetic
