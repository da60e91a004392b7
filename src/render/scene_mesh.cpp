// SPDX-License-Identifier: Apache-2.0
#include "render/scene_mesh.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace theatron::render {

MeshData make_box_mesh(Vec3 low, Vec3 high) {
    MeshData mesh;
    const double l[] = {low.x, low.y, low.z}, h[] = {high.x, high.y, high.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            const auto first = std::uint32_t(mesh.vertices.size());
            for (int corner = 0; corner < 4; ++corner) {
                double p[3], n[3] = {0, 0, 0};
                p[axis] = side ? h[axis] : l[axis];
                p[u] = corner == 1 || corner == 2 ? h[u] : l[u];
                p[v] = corner >= 2 ? h[v] : l[v];
                n[axis] = side ? 1 : -1;
                mesh.vertices.push_back(
                    {float(p[0]), float(p[1]), float(p[2]), float(n[0]), float(n[1]), float(n[2])});
            }
            const std::uint32_t outside[] = {0, 1, 2, 0, 2, 3}, inside[] = {0, 2, 1, 0, 3, 2};
            for (const std::uint32_t i : side ? outside : inside)
                mesh.indices.push_back(first + i);
        }
    return mesh;
}

MeshData make_sphere_mesh(double radius, int rings) {
    MeshData mesh;
    const int columns = 2 * rings;
    for (int r = 0; r <= rings; ++r)
        for (int c = 0; c <= columns; ++c) {
            const double down = std::numbers::pi * r / rings, around = std::numbers::pi * c / rings;
            const Vec3 n{std::sin(down) * std::sin(around), std::cos(down),
                         std::sin(down) * std::cos(around)};
            mesh.vertices.push_back({float(n.x * radius), float(n.y * radius), float(n.z * radius),
                                     float(n.x), float(n.y), float(n.z)});
        }
    const auto at = [&](int r, int c) { return std::uint32_t(r * (columns + 1) + c); };
    for (int r = 0; r < rings; ++r)
        for (int c = 0; c < columns; ++c) {
            const std::uint32_t cell[] = {at(r, c), at(r + 1, c),     at(r + 1, c + 1),
                                          at(r, c), at(r + 1, c + 1), at(r, c + 1)};
            mesh.indices.insert(mesh.indices.end(), std::begin(cell), std::end(cell));
        }
    return mesh;
}

SceneMesh::SceneMesh(const MeshData& data) : buffers_(std::make_unique<Buffers>()) {
    using Vertex = MeshData::Vertex;
    glBindVertexArray(buffers_->attributes.name());
    glBindBuffer(GL_ARRAY_BUFFER, buffers_->vertices.name());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(data.vertices.size() * sizeof(Vertex)),
                 data.vertices.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_->indices.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(data.indices.size() * sizeof(std::uint32_t)),
                 data.indices.data(), GL_STATIC_DRAW);
    const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), offset(offsetof(Vertex, px)));
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), offset(offsetof(Vertex, nx)));
    glBindVertexArray(0);
    buffers_->count = GLsizei(data.indices.size());
}

SceneMesh::~SceneMesh() = default;
SceneMesh::SceneMesh(SceneMesh&&) noexcept = default;
SceneMesh& SceneMesh::operator=(SceneMesh&&) noexcept = default;

void SceneMesh::Buffers::draw() const {
    glBindVertexArray(attributes.name());
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);
}

}  // namespace theatron::render
