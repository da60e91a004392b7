// SPDX-License-Identifier: Apache-2.0
#include "face/face_triangles.h"

namespace theatron::face {

EnrolledFace with_triangles(const EnrolledFace& face,
                            const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const FaceMesh& rest = face.rest;
    std::vector<std::uint32_t> numbers(rest.vertex_count(), gone_vertex);
    EnrolledFace result;
    result.colors = face.colors;
    result.textures = face.textures;
    std::vector<std::uint32_t> kept;
    std::size_t triangle = 0;
    for (std::size_t part = 0; part < part_count; ++part)
        for (std::uint32_t i = 0; i < rest.part_sizes[part]; ++i, ++triangle) {
            auto corners = triangles[triangle];
            if (corners[0] == gone_vertex)
                continue;
            for (std::uint32_t& corner : corners) {
                if (numbers[corner] == gone_vertex) {
                    numbers[corner] = std::uint32_t(kept.size());
                    kept.push_back(corner);
                }
                corner = numbers[corner];
            }
            result.rest.triangles.push_back(corners);
            ++result.rest.part_sizes[part];
        }
    for (const std::uint32_t vertex : kept) {
        for (std::size_t k = 0; k < 3; ++k) {
            result.rest.points.push_back(rest.points[3 * std::size_t(vertex) + k]);
            for (std::size_t m = 0; m < move_count; ++m)
                result.moves[m].push_back(face.moves[m][3 * std::size_t(vertex) + k]);
        }
        for (std::size_t k = 0; k < 2; ++k)
            result.rest.places.push_back(rest.places[2 * std::size_t(vertex) + k]);
    }
    return result;
}

}  // namespace theatron::face
