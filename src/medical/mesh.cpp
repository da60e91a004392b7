// SPDX-License-Identifier: Apache-2.0
#include "medical/mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "base/float_bytes.h"
#include "medical/volume.h"

namespace theatron::medical {
namespace {

constexpr char magic[] = {'T', 'H', 'M', 'E'};
constexpr std::uint8_t version = 1;
constexpr std::size_t header_size = 16;
constexpr std::size_t vertex_size = 24, triangle_size = 12;

std::byte* put(std::byte* out, const std::vector<Vec3f>& list) {
    for (const Vec3f v : list)
        for (const float coordinate : {v.x, v.y, v.z}) {
            store_f32(out, coordinate);
            out += sizeof(coordinate);
        }
    return out;
}

const std::byte* get(const std::byte* in, std::vector<Vec3f>& list) {
    for (Vec3f& v : list) {
        v = {load_f32(in), load_f32(in + 4), load_f32(in + 8)};
        in += 12;
    }
    return in;
}

bool is_position(Vec3f v) {
    const auto limit = float(max_coordinate_mm);
    return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
}

bool is_normal(Vec3f v) {
    return std::abs(dot(to_double(v), to_double(v)) - 1) < 0.01;
}

}  // namespace

void compute_normals(Mesh& mesh) {
    std::vector<Vec3> sums(mesh.positions.size());
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = to_double(mesh.positions[t[0]]), b = to_double(mesh.positions[t[1]]),
                   c = to_double(mesh.positions[t[2]]);
        const Vec3 normal = cross(b - a, c - a);
        for (const std::uint32_t v : t)
            sums[v] = sums[v] + normal;
    }
    mesh.normals.resize(mesh.positions.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double l = length(sums[i]);
        mesh.normals[i] = l > 1e-30 ? to_float(sums[i] * (1 / l)) : Vec3f{0, 0, 1};
    }
}

Bytes encode_mesh(const Mesh& mesh) {
    assert(mesh.normals.size() == mesh.positions.size());
    assert(mesh.positions.size() <= max_mesh_vertices &&
           mesh.triangles.size() <= max_mesh_triangles);
    Bytes out(header_size + vertex_size * mesh.positions.size() +
              triangle_size * mesh.triangles.size());
    std::memcpy(out.data(), magic, sizeof(magic));
    out[4] = std::byte(version);
    store_le(out.data() + 8, std::uint32_t(mesh.positions.size()));
    store_le(out.data() + 12, std::uint32_t(mesh.triangles.size()));
    std::byte* at = put(put(out.data() + header_size, mesh.positions), mesh.normals);
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t) {
            store_le(at, v);
            at += 4;
        }
    return out;
}

Result<Mesh> decode_mesh(ByteView bytes) {
    if (bytes.size() < header_size)
        return Status::truncated;
    if (std::memcmp(bytes.data(), magic, sizeof(magic)) != 0)
        return Status::malformed;
    if (bytes[4] != std::byte(version))
        return bytes[4] > std::byte(version) ? Status::unsupported_version : Status::malformed;
    if (bytes[5] != std::byte(0) || bytes[6] != std::byte(0) || bytes[7] != std::byte(0))
        return Status::malformed;
    const std::size_t vertices = load_le<std::uint32_t>(bytes.data() + 8);
    const std::size_t triangles = load_le<std::uint32_t>(bytes.data() + 12);
    if (vertices > max_mesh_vertices || triangles > max_mesh_triangles)
        return Status::too_large;
    const std::size_t needed = header_size + vertex_size * vertices + triangle_size * triangles;
    if (bytes.size() != needed)
        return bytes.size() < needed ? Status::truncated : Status::trailing_bytes;

    Mesh mesh;
    mesh.positions.resize(vertices);
    mesh.normals.resize(vertices);
    mesh.triangles.resize(triangles);
    const std::byte* at = get(get(bytes.data() + header_size, mesh.positions), mesh.normals);
    for (Triangle& t : mesh.triangles)
        for (std::uint32_t& v : t) {
            v = load_le<std::uint32_t>(at);
            at += 4;
            if (v >= vertices)
                return Status::malformed;
        }
    if (!std::all_of(mesh.positions.begin(), mesh.positions.end(), is_position) ||
        !std::all_of(mesh.normals.begin(), mesh.normals.end(), is_normal))
        return Status::malformed;
    return mesh;
}

}  // namespace theatron::medical
