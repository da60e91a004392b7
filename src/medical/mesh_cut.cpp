// SPDX-License-Identifier: Apache-2.0
#include "medical/mesh_cut.h"

namespace theatron::medical {

std::vector<Segment> cut_mesh(const Mesh& mesh, Vec3 point, Vec3 normal) {
    std::vector<double> heights;
    heights.reserve(mesh.positions.size());
    for (const Vec3f p : mesh.positions)
        heights.push_back(dot(to_double(p) - point, normal));
    std::vector<Segment> segments;
    for (const Triangle& t : mesh.triangles) {
        Vec3 ends[2];
        int count = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i], b = t[(i + 1) % 3];
            // A vertex in the plane counts as above it, so that each edge is cut once or not.
            if ((heights[a] < 0) == (heights[b] < 0))
                continue;
            const double share = heights[a] / (heights[a] - heights[b]);
            ends[count++] =
                to_double(mesh.positions[a]) * (1 - share) + to_double(mesh.positions[b]) * share;
        }
        if (count == 2)
            segments.push_back({ends[0], ends[1]});
    }
    return segments;
}

}  // namespace theatron::medical
