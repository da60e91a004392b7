// SPDX-License-Identifier: Apache-2.0
#include "face/face_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace theatron::face {

HeadPart FaceMesh::part_of(std::size_t triangle) const {
    std::size_t end = 0;
    for (std::size_t i = 0; i < part_count; ++i)
        if (triangle < (end += part_sizes[i]))
            return HeadPart(i);
    return HeadPart::skin;
}

FaceMesh mesh_of(const MorphModel& model, std::span<const float> identity,
                 const Channels& channels) {
    FaceMesh mesh;
    mesh.points.resize(model.neutral.size());
    blend_shape(model, identity, channels, mesh.points);
    mesh.places = model.places;
    mesh.triangles = model.triangles;
    mesh.part_sizes = model.part_sizes;
    return mesh;
}

std::vector<Vec3> normals_of(const FaceMesh& mesh) {
    std::map<std::array<float, 3>, std::size_t> at_point;
    std::vector<std::size_t> joined(mesh.vertex_count());
    for (std::size_t i = 0; i < joined.size(); ++i)
        joined[i] = at_point
                        .try_emplace(
                            {mesh.points[3 * i], mesh.points[3 * i + 1], mesh.points[3 * i + 2]}, i)
                        .first->second;
    std::vector<Vec3> normals(mesh.vertex_count());
    for (const auto& corners : mesh.triangles) {
        const Vec3 a = mesh.point(corners[0]);
        // As long as the triangle is large, so that small ones count little.
        const Vec3 normal = cross(mesh.point(corners[1]) - a, mesh.point(corners[2]) - a);
        for (const std::uint32_t corner : corners)
            normals[joined[corner]] = normals[joined[corner]] + normal;
    }
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const double size = length(normals[joined[i]]);
        normals[i] = size > 0 ? normals[joined[i]] * (1 / size) : Vec3{0, 0, 1};
    }
    return normals;
}

double focal_of(Size size, double view_degrees) {
    return std::max(size.width, size.height) / (2 * std::tan(radians_of(view_degrees) / 2));
}

}  // namespace theatron::face
