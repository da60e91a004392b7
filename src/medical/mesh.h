// SPDX-License-Identifier: Apache-2.0
// The surface of an organ's part, and the bytes of the mesh files of a case
// (docs/formats/case_mesh.md).
//
// Positions are patient coordinates (LPS) in millimetres; triangles turn counter-clockwise seen
// from outside. All functions are pure and safe to call from any thread.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/bytes.h"
#include "base/status.h"
#include "geometry/vec.h"

namespace theatron::medical {

inline constexpr std::size_t max_mesh_vertices = std::size_t(1) << 24;
inline constexpr std::size_t max_mesh_triangles = std::size_t(1) << 24;

struct Vec3f {
    float x = 0, y = 0, z = 0;
    bool operator==(const Vec3f&) const = default;
};
inline Vec3 to_double(Vec3f v) {
    return {v.x, v.y, v.z};
}
inline Vec3f to_float(Vec3 v) {
    return {float(v.x), float(v.y), float(v.z)};
}

using Triangle = std::array<std::uint32_t, 3>;  // indices of vertices

struct Mesh {
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals;  // one for each position, of length 1
    std::vector<Triangle> triangles;
    bool operator==(const Mesh&) const = default;
};

// Gives each vertex the mean of its triangles' normals, weighted by their areas.
void compute_normals(Mesh& mesh);

// `mesh` must have as many normals as positions and be within the bounds above.
Bytes encode_mesh(const Mesh& mesh);

// Safe for any bytes: takes memory in proportion to their number.
Result<Mesh> decode_mesh(ByteView bytes);

}  // namespace theatron::medical
