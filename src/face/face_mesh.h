// SPDX-License-Identifier: Apache-2.0
// One face as triangles, and a camera that sees it. Pure.
#pragma once

#include "face/morph_model.h"
#include "image/view.h"

namespace theatron::face {

// As MorphModel has them: millimetres, places in the texture, triangles in the order of parts.
struct FaceMesh {
    std::vector<float> points;  // x, y, z of each vertex
    std::vector<float> places;  // u, v of each vertex
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::array<std::uint32_t, part_count> part_sizes{};

    std::size_t vertex_count() const { return points.size() / 3; }
    Vec3 point(std::size_t vertex) const {
        return {points[3 * vertex], points[3 * vertex + 1], points[3 * vertex + 2]};
    }
    std::size_t skin_size() const { return part_sizes[std::size_t(HeadPart::skin)]; }
    HeadPart part_of(std::size_t triangle) const;
};

// A person of the model.
FaceMesh mesh_of(const MorphModel& model, std::span<const float> identity,
                 const Channels& channels);

// One for each vertex, outwards and of length 1. Vertices at the same point have one normal: they
// were parted for the texture only.
std::vector<Vec3> normals_of(const FaceMesh& mesh);

// A camera without distortion: x right, y down, z forward.
struct FaceCamera {
    Pose camera_from_face;  // millimetres
    double focal_px = 0;
    Vec2 centre_px;

    // z is the depth in millimetres; x and y are no numbers of a picture where it is not positive.
    Vec3 project(Vec3 face) const {
        const Vec3 p = camera_from_face * face;
        const double scale = p.z > 0 ? focal_px / p.z : 0;
        return {p.x * scale + centre_px.x, p.y * scale + centre_px.y, p.z};
    }
};

// Focal length in pixels of a camera that sees this angle along the longer side.
double focal_of(Size size, double view_degrees);

}  // namespace theatron::face
