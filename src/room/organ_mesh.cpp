// SPDX-License-Identifier: Apache-2.0
#include "room/organ_mesh.h"

#include "image/srgb.h"

namespace theatron::room {
namespace {

constexpr double m_per_mm = 0.001;

// A rotation, so triangles keep their outer side.
Vec3 turned(Vec3 lps) {
    return {lps.x, lps.z, -lps.y};
}

}  // namespace

Vec3 organ_from_patient(Vec3 patient_mm, Vec3 middle_mm) {
    return turned(patient_mm - middle_mm) * m_per_mm;
}

Vec3 patient_from_organ(Vec3 organ_m, Vec3 middle_mm) {
    return Vec3{organ_m.x, -organ_m.z, organ_m.y} * (1 / m_per_mm) + middle_mm;
}

render::MeshData make_organ_mesh(const medical::Mesh& mesh, Vec3 middle_mm) {
    render::MeshData data;
    data.vertices.reserve(mesh.positions.size());
    data.indices.reserve(3 * mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Vec3 p = organ_from_patient(medical::to_double(mesh.positions[i]), middle_mm);
        const Vec3 n = turned(medical::to_double(mesh.normals[i]));
        data.vertices.push_back(
            {float(p.x), float(p.y), float(p.z), float(n.x), float(n.y), float(n.z)});
    }
    for (const medical::Triangle& t : mesh.triangles)
        data.indices.insert(data.indices.end(), t.begin(), t.end());
    return data;
}

Vec3 linear_color(Rgb color) {
    const auto linear = [](std::uint8_t c) { return srgb_to_linear(c / 255.0); };
    return {linear(color.r), linear(color.g), linear(color.b)};
}

}  // namespace theatron::room
