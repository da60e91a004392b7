// SPDX-License-Identifier: Apache-2.0
#include "face/sent_face.h"

#include <algorithm>

#include "face/face_triangles.h"

namespace theatron::face {
namespace {

// Below the eyes, where a figure's collar begins.
constexpr double neck_below_eyes_mm = 190;

}  // namespace

Vec3 between_eyes(const EnrolledFace& face) {
    const FaceMesh& rest = face.rest;
    std::size_t triangle = 0;
    for (std::size_t part = 0; part < std::size_t(HeadPart::iris); ++part)
        triangle += rest.part_sizes[part];
    const std::size_t irises = rest.part_sizes[std::size_t(HeadPart::iris)];
    Vec3 middle;
    if (irises > 0) {
        for (std::size_t i = 0; i < irises; ++i)
            for (const std::uint32_t corner : rest.triangles[triangle + i])
                middle = middle + (1.0 / (3.0 * double(irises))) * rest.point(corner);
        return middle;
    }
    // Each lid counts the same, however many vertices it has; those that move most are at the eye.
    double lids = 0;
    for (const Move move : {Move::blink_left, Move::blink_right}) {
        const std::vector<float>& offsets = face.moves[std::size_t(move)];
        Vec3 sum;
        double weight = 0;
        for (std::size_t i = 0; i < rest.vertex_count(); ++i) {
            const Vec3 offset{offsets[3 * i], offsets[3 * i + 1], offsets[3 * i + 2]};
            sum = sum + dot(offset, offset) * rest.point(i);
            weight += dot(offset, offset);
        }
        if (weight > 0) {
            middle = middle + (1 / weight) * sum;
            ++lids;
        }
    }
    return lids > 0 ? (1 / lids) * middle : middle;
}

EnrolledFace without_shoulders(const EnrolledFace& face) {
    const double lowest = between_eyes(face).y - neck_below_eyes_mm;
    auto triangles = face.rest.triangles;
    for (auto& corners : triangles)
        if (std::any_of(corners.begin(), corners.end(),
                        [&](std::uint32_t corner) { return face.rest.point(corner).y < lowest; }))
            corners.fill(gone_vertex);
    return with_triangles(face, triangles);
}

Result<EnrolledFace> parse_sent_face(ByteView bytes) {
    auto face = parse_enrolled(bytes);
    if (face && (face->rest.vertex_count() > max_sent_vertices ||
                 face->rest.triangles.size() > max_sent_triangles))
        return Status::too_large;
    return face;
}

}  // namespace theatron::face
