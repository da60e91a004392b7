// SPDX-License-Identifier: Apache-2.0
// Combines meshes, and precomputes ambient occlusion ("openness").
#include "synthetic/noise.h"
#include "synthetic/scene.h"

namespace theatron::synthetic {

void MovingMesh::append(const Mesh& part, std::uint16_t bone) {
    mesh.append(part);
    influences.resize(mesh.positions.size(), Influence{{bone, 0, 0, 0}, {1, 0, 0, 0}});
}

void MovingMesh::append(const Mesh& part, const std::vector<Influence>& bones) {
    mesh.append(part);
    influences.insert(influences.end(), bones.begin(), bones.end());
}

void bake_openness(Mesh& mesh, int directions, const Pulse& pulse) {
    // Each direction is a distant camera with a narrow field: nearly parallel rays.
    constexpr int side = 420;
    constexpr double far_away = 60;
    const SampleGrid grid = make_grid(pinhole({side, side}, 7.6));
    std::vector<float> seen_weight(mesh.positions.size()), weight(mesh.positions.size());
    std::vector<F3> local;
    Visibility seen;
    // The walls and the ceiling would hide everything, so they do not block light.
    std::vector<Triangle> hiding;
    for (const Triangle& t : mesh.triangles)
        if (t.look != Look::wall && t.look != Look::wall_panel && t.look != Look::ceiling)
            hiding.push_back(t);
    for (int i = 0; i < directions; ++i) {
        // Spread evenly over the upper hemisphere and slightly below the horizon.
        const float y = 1 - 1.25f * (float(i) + 0.5f) / float(directions);
        const float turn = float(i) * 2.39996f;
        const float r = std::sqrt(1 - y * y);
        const F3 direction{r * std::cos(turn), y, r * std::sin(turn)};
        const Vec3 middle{0, 1.2, 0};
        const Pose pose = look_at(middle + to_vec3(direction) * far_away, middle,
                                  std::abs(y) > 0.99f ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
        transform(mesh.positions, to_affine(inverse(pose)), local);
        seen.clear({side, side});
        rasterise(grid, local, hiding, 0, seen, pulse);
        for (std::size_t v = 0; v < local.size(); ++v) {
            const float facing = dot(mesh.normals[v], direction);
            if (facing <= 0.02f)
                continue;
            const F3 p = local[v] + F3{0, 0, -0.03f};
            const auto& c = grid.camera;
            const int x = int(std::lround(double(p.x / p.z) * c.fx + c.cx));
            const int yy = int(std::lround(double(p.y / p.z) * c.fy + c.cy));
            weight[v] += facing;
            if (x < 0 || yy < 0 || x >= side || yy >= side ||
                p.z < seen.depth.view().row(yy)[x] + 0.02f)
                seen_weight[v] += facing;
        }
    }
    // Walls and ceiling keep their value: their meshes are too coarse for occlusion per vertex.
    for (const Triangle& t : mesh.triangles)
        if (t.look == Look::wall || t.look == Look::wall_panel || t.look == Look::ceiling)
            weight[t.a] = weight[t.b] = weight[t.c] = 0;
    for (std::size_t v = 0; v < weight.size(); ++v)
        if (weight[v] > 0)
            mesh.openness[v] *= 0.25f + 0.75f * seen_weight[v] / weight[v];
}

}  // namespace theatron::synthetic
