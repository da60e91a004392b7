// SPDX-License-Identifier: Apache-2.0
#include "room/mesh_parts.h"

namespace theatron::room {

void append(render::MeshData& mesh, const render::MeshData& part, Vec3 scale, Vec3 place) {
    const auto first = std::uint32_t(mesh.vertices.size());
    for (render::MeshData::Vertex v : part.vertices) {
        v.px = float(v.px * scale.x + place.x);
        v.py = float(v.py * scale.y + place.y);
        v.pz = float(v.pz * scale.z + place.z);
        // Normals scale by the inverse.
        const Vec3 n = normalized(Vec3{v.nx / scale.x, v.ny / scale.y, v.nz / scale.z});
        v.nx = float(n.x);
        v.ny = float(n.y);
        v.nz = float(n.z);
        mesh.vertices.push_back(v);
    }
    for (const std::uint32_t i : part.indices)
        mesh.indices.push_back(first + i);
}

}  // namespace theatron::room
